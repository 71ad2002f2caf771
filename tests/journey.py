"""A stranger's journey through the JSON API of a running server, which checks every number it is told.

    python tests/journey.py http://127.0.0.1:8000 [--seed 5] [--size 7]

Standard library only; nothing of app or irl_core is imported. It makes a world, plays three successes and three
failures found by its own planner, ranks them, runs five learners, follows the event stream with one reconnection,
and recomputes from the formulas: totals, places, weights, the optimum, the human's mean, and what each returned policy
is worth. Everything must agree to 1e-9.
"""

import argparse
import json
import math
import statistics
import sys
import urllib.error
import urllib.request
import uuid
from collections.abc import Iterator
from http.cookiejar import CookieJar
from typing import Any

LEARNERS = ("meirl", "irlr", "irlf", "irlfr", "birlfr")
MOVES = ((-1, 0), (0, 1), (1, 0), (0, -1))  # up, right, down, left
TOLERANCE = 1e-9

Json = dict[str, Any]
Row = tuple[str, float, float]  # what was checked, the server's number, ours


def main() -> int:
    parser = argparse.ArgumentParser(
        description="Play, rank, learn and compare through the API, checking every number."
    )
    parser.add_argument("address", nargs="?", default="http://127.0.0.1:8000")
    parser.add_argument("--seed", type=int, default=None, help="the world's seed; the server draws one if left out")
    parser.add_argument("--size", type=int, default=7, help="rows and columns of the world")
    arguments = parser.parse_args()
    rows = journey(arguments.address, seed=arguments.seed, size=arguments.size)
    print_table(rows)
    return 0 if worst(rows) <= TOLERANCE else 1


def journey(address: str, *, seed: int | None = None, size: int = 7, **more: Any) -> list[Row]:
    """Walk the whole path; return what was compared. `more` is what else the world is made from."""
    client = Client(address)
    spec: Json = {"rows": size, "cols": size} | ({} if seed is None else {"seed": seed}) | more
    world = client.post("/worlds", spec)
    grid = Grid(world)
    successes, failures = play(client, grid, world["id"])
    rows = check_demonstrations(grid, [*successes, *failures])
    rows += rank(client, world["id"], successes, failures)
    run = learn(client, world["id"])
    comparison = client.get(f"/runs/{run['id']}/comparison")
    rollouts = client.get(f"/runs/{run['id']}/rollouts")
    return rows + check_comparison(grid, [*successes, *failures], run, comparison, rollouts)


class Client:
    """One visitor: a cookie jar and JSON both ways."""

    def __init__(self, address: str) -> None:
        self.base = address.rstrip("/") + "/api/v1"
        self._opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))

    def get(self, path: str) -> Any:
        return self._call("GET", path)

    def post(self, path: str, body: Json) -> Any:
        return self._call("POST", path, body)

    def put(self, path: str, body: Json) -> Any:
        return self._call("PUT", path, body)

    def events(self, path: str, *, after: str | None = None) -> Iterator[tuple[str, str, Json]]:
        """The events of a stream as (id, name, data), until the server closes it."""
        headers = {"Accept": "text/event-stream"} | ({} if after is None else {"Last-Event-ID": after})
        with self._opener.open(urllib.request.Request(self.base + path, headers=headers), timeout=120) as stream:
            fields: dict[str, str] = {}
            for raw in stream:
                name, _, value = raw.decode().rstrip("\r\n").partition(":")
                if name:
                    fields[name] = value.removeprefix(" ")
                elif "data" in fields:
                    yield fields.get("id", ""), fields.get("event", "message"), json.loads(fields["data"])
                    fields = {}

    def _call(self, method: str, path: str, body: Json | None = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with self._opener.open(request, timeout=60) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            raise SystemExit(f"{method} {path}: {error.code} {error.read().decode()[:500]}") from None


class Grid:
    """The rules of the world, written from the paper: a step pays the reward of the square it reaches."""

    def __init__(self, world: Json) -> None:
        self.rows, self.cols = world["rows"], world["cols"]
        self.start, self.goals, self.walls = world["start"], set(world["goals"]), set(world["walls"])
        self.rewards = [reward for row in world["rewards"] for reward in row]
        self.horizon, self.slip = world["horizon"], world["slip"]

    def reached(self, state: int, action: int) -> int:
        row, col = divmod(state, self.cols)
        row, col = row + MOVES[action][0], col + MOVES[action][1]
        inside = 0 <= row < self.rows and 0 <= col < self.cols
        return state if not inside or row * self.cols + col in self.walls else row * self.cols + col

    def walk(self, actions: list[int]) -> tuple[list[int], float]:
        """The states an attempt without slip passes, and its total."""
        states = [self.start]
        for action in actions:
            states.append(self.reached(states[-1], action))
        return states, math.fsum(self.rewards[state] for state in states[1:])

    def optimum(self) -> float:
        """The largest expected total within the horizon, by backward induction (s' drawn by slip)."""
        value = [0.0] * (self.rows * self.cols)
        for _ in range(self.horizon):
            value = [
                0.0 if state in self.goals else max(self._backup(value, state, action) for action in range(4))
                for state in range(len(value))
            ]
        return value[self.start]

    def worth(self, policy: list[list[float]]) -> float:
        """The expected total of a stationary policy within the horizon."""
        value = [0.0] * (self.rows * self.cols)
        for _ in range(self.horizon):
            value = [
                0.0
                if state in self.goals
                else math.fsum(policy[state][action] * self._backup(value, state, action) for action in range(4))
                for state in range(len(value))
            ]
        return value[self.start]

    def greedy_worth(self, learned: list[list[float]]) -> float:
        """The true expected total of the plan that earns most of the learned reward and reaches a goal in time.

        The plan knows the steps left; of equally good actions it takes the first.
        """
        reward = [value for row in learned for value in row]
        squares = range(self.rows * self.cols)
        plan_value = [0.0 if state in self.goals else -math.inf for state in squares]
        worth = [0.0] * len(plan_value)
        for _ in range(self.horizon):
            ahead = [reward[state] + plan_value[state] for state in squares]
            choices = [[self._mean(ahead, state, action) for action in range(4)] for state in squares]
            best = [choices[state].index(max(choices[state])) for state in squares]
            worth = [0.0 if state in self.goals else self._backup(worth, state, best[state]) for state in squares]
            plan_value = [0.0 if state in self.goals else choices[state][best[state]] for state in squares]
        return worth[self.start]

    def cheapest_path(self, toll: list[float]) -> list[int]:
        """The actions of the cheapest path to a goal, when entering a square costs its toll (Bellman–Ford)."""
        best: dict[int, tuple[float, list[int]]] = {self.start: (0.0, [])}
        for _ in range(self.rows * self.cols):
            for state, (cost, actions) in list(best.items()):
                if state in self.goals:
                    continue
                for action in range(4):
                    reached = self.reached(state, action)
                    reached_cost = cost + toll[reached]
                    if reached not in best or reached_cost < best[reached][0] - 1e-12:
                        best[reached] = (reached_cost, [*actions, action])
        return min((best[goal] for goal in self.goals if goal in best), key=lambda found: found[0])[1]

    def _backup(self, value: list[float], state: int, action: int) -> float:
        """What an action is worth: the reward of the square reached, and its value."""
        return self._mean([reward + ahead for reward, ahead in zip(self.rewards, value, strict=True)], state, action)

    def _mean(self, figures: list[float], state: int, action: int) -> float:
        """The mean of a figure over the squares that an action may reach."""
        intended = (1 - self.slip) * figures[self.reached(state, action)]
        if self.slip == 0:
            return intended
        others = (figures[self.reached(state, direction)] for direction in range(4) if direction != action)
        return intended + self.slip / 3 * math.fsum(others)


def play(client: Client, grid: Grid, world_id: str) -> tuple[list[Json], list[Json]]:
    """Three attempts of each outcome, all ending at the goal, best success and worst failure first."""
    wise = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    blind = grid.cheapest_path([1.0 for _ in grid.rewards])
    successes = [send(client, world_id, actions) for actions in three_of(grid, wise, success=True)]
    failures = [send(client, world_id, actions) for actions in three_of(grid, blind, success=False)]
    listed = client.get(f"/worlds/{world_id}/demonstrations")
    expect(
        [item["id"] for item in listed] == [item["id"] for item in [*successes, *failures]], "the list, oldest first"
    )
    return sorted(successes, key=lambda item: -item["total"]), sorted(failures, key=lambda item: item["total"])


def three_of(grid: Grid, path: list[int], *, success: bool) -> list[list[int]]:
    """The path with 0, 1, 2, … detours, three that have the outcome; the last again where detours leave no third."""
    detour = max(detours(grid, path), key=lambda found: found[0] if success else -found[0])[1]
    candidates = [path[: detour[0]] + list(detour[1]) * n + path[detour[0] :] for n in range(grid.horizon)]
    found = [
        actions for actions in candidates if len(actions) <= grid.horizon and (grid.walk(actions)[1] >= 0) == success
    ][:3]
    expect(bool(found), f"a {'success' if success else 'failure'} can be played here")
    return [found[min(index, len(found) - 1)] for index in range(3)]


def detours(grid: Grid, path: list[int]) -> Iterator[tuple[float, tuple[int, tuple[int, ...]]]]:
    """What a detour costs, where in the path it goes in, and its moves: a bump, or a step there and back."""
    for place, state in enumerate(grid.walk(path)[0][:-1]):
        for action in range(4):
            reached = grid.reached(state, action)
            if reached == state:
                yield grid.rewards[state], (place, (action,))
            elif reached not in grid.goals:
                yield grid.rewards[reached] + grid.rewards[state], (place, (action, (action + 2) % 4))


def send(client: Client, world_id: str, actions: list[int]) -> Json:
    body = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [250.0] * len(actions), "ending": "goal"}
    answer: Json = client.post(f"/worlds/{world_id}/demonstrations", body)
    expect(client.post(f"/worlds/{world_id}/demonstrations", body) == answer, "a retry answers the same")
    return answer


def check_demonstrations(grid: Grid, demonstrations: list[Json]) -> list[Row]:
    rows = []
    for number, item in enumerate(demonstrations, 1):
        states, total = grid.walk(item["actions"])
        expect(item["states"] == states, f"the squares of attempt {number}")
        expect(item["outcome"] == ("success" if total >= 0 else "failure"), f"the outcome of attempt {number}")
        rows.append((f"total of attempt {number} ({item['outcome']})", item["total"], total))
    return rows


def rank(client: Client, world_id: str, successes: list[Json], failures: list[Json]) -> list[Row]:
    """Confirm both orders, equal totals tied, and compare the weights with 2i / (N (N + 1)), shared within ties."""
    rows = []
    for outcome, ordered in (("success", successes), ("failure", failures)):
        groups: list[list[Json]] = []
        for item in ordered:
            if groups and abs(groups[-1][0]["total"] - item["total"]) < TOLERANCE:
                groups[-1].append(item)
            else:
                groups.append([item])
        order = [[item["id"] for item in group] for group in groups]
        answer = client.put(f"/worlds/{world_id}/rankings/{outcome}", {"order": order, "confirmed": True})
        n, place = len(ordered), len(ordered)
        for group in order:
            weight = statistics.fmean(2 * i / (n * (n + 1)) for i in range(place - len(group) + 1, place + 1))
            rows += [(f"weight of {outcome} {n - place + 1}", answer["weights"][id_], weight) for id_ in group]
            place -= len(group)
    return rows


def learn(client: Client, world_id: str) -> Json:
    """Run the learners; leave the stream once in the middle and resume it."""
    run = client.post(f"/worlds/{world_id}/runs", {"learners": list(LEARNERS), "settings": {}, "seed": 7})
    path = f"/runs/{run['id']}/events"
    seen: list[tuple[str, str, Json]] = []
    for event in client.events(path):
        seen.append(event)
        if len(seen) == 3:
            break  # the connection is lost
    seen += client.events(path, after=seen[-1][0])
    expect(
        [int(id_) for id_, _, _ in seen] == list(range(1, len(seen) + 1)), "events are numbered without gap or repeat"
    )
    expect(seen[-1][1] == "done", f"the last event is done, not {seen[-1][1:]}")
    ended = [data["learner"] for _, name, data in seen if name == "learner"]
    expect(sorted(ended) == sorted(LEARNERS), "each learner ends once")
    expect({data["learner"] for _, name, data in seen if name == "frame"} == set(LEARNERS), "each learner shows frames")
    finished: Json = client.get(f"/runs/{run['id']}")
    expect(finished["status"] == "done", "the run is done")
    return finished


def check_comparison(grid: Grid, demonstrations: list[Json], run: Json, comparison: Json, rollouts: Json) -> list[Row]:
    """Recompute every figure of every entry."""
    entries = {entry["who"]: entry for entry in comparison["entries"]}
    expect(set(entries) == {"human", "optimal", *LEARNERS}, "who is compared")
    expect(comparison["horizon"] == grid.horizon, "the horizon of the comparison")
    totals = [item["total"] for item in demonstrations]
    optimum, human = grid.optimum(), statistics.fmean(totals)
    worth = {"human": human, "optimal": optimum}
    rows: list[Row] = [
        ("human mean_return", entries["human"]["mean_return"], human),
        ("human standard_error", entries["human"]["standard_error"], statistics.stdev(totals) / math.sqrt(len(totals))),
        ("optimal expected_return", entries["optimal"]["expected_return"], optimum),
    ]
    for name in LEARNERS:
        result = run["learners"][name]
        worth[name] = grid.worth(result["policy"])
        rows.append((f"{name} expected_return", entries[name]["expected_return"], worth[name]))
        rows.append((f"{name} greedy_return", entries[name]["greedy_return"], grid.greedy_worth(result["reward"])))
        rows += [
            (f"{name} policy row", math.fsum(row), 1.0) for row in result["policy"] if abs(math.fsum(row) - 1) > 1e-12
        ]
    for name in (*LEARNERS, "optimal"):
        episodes = [math.fsum(grid.rewards[state] for state in item["states"][1:]) for item in rollouts[name]]
        expect(len(episodes) == entries[name]["episodes"], f"{name}'s episodes")
        rows.append((f"{name} mean_return", entries[name]["mean_return"], statistics.fmean(episodes)))
        error = statistics.stdev(episodes) / math.sqrt(len(episodes))
        rows.append((f"{name} standard_error", entries[name]["standard_error"], error))
    for name, value in worth.items():
        place = 1 + sum(other > value + TOLERANCE for other in worth.values())
        rows.append((f"{name} place", entries[name]["place"], place))
        if optimum > 0:
            rows.append((f"{name} share_of_optimum", entries[name]["share_of_optimum"], value / optimum))
    return rows


def expect(holds: bool, what: str) -> None:  # noqa: FBT001 - reads as a sentence: expect(x == y, "...")
    if not holds:
        raise SystemExit(f"does not hold: {what}")


def worst(rows: list[Row]) -> float:
    return max(abs(told - ours) / max(1.0, abs(ours)) for _, told, ours in rows)


def print_table(rows: list[Row]) -> None:
    width = max(len(what) for what, _, _ in rows)
    print(f"{'':{width}}  {'server':>22}  {'recomputed':>22}  difference")
    for what, told, ours in rows:
        print(f"{what:{width}}  {told:22.15g}  {ours:22.15g}  {abs(told - ours):10.1e}")
    verdict = "agrees" if worst(rows) <= TOLERANCE else "DOES NOT AGREE"
    print(f"{verdict}: largest relative difference {worst(rows):.1e} over {len(rows)} figures")


if __name__ == "__main__":
    sys.exit(main())
