"""The command `irlfr`."""

import json
import os
import signal
import socket
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from pydantic import ValidationError

from app.config import Settings

cli = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Play a gridworld, fail, rank your attempts, and watch algorithms learn from them.",
)

BAD_INPUT = 2
STOPPED = 130  # what a shell reports of a program that Ctrl-C ended


def main() -> None:
    """Run the command line."""
    cli()


@cli.command()
def serve(
    host: Annotated[str | None, typer.Option(help="The address to listen on (IRLFR_HOST).")] = None,
    port: Annotated[int | None, typer.Option(help="The port to listen on (IRLFR_PORT).", min=1, max=65535)] = None,
    workers: Annotated[
        int | None, typer.Option(help="How many learning workers to start (IRLFR_WORKERS).", min=0, max=64)
    ] = None,
) -> None:
    """Bring the database up to date, start the workers, and serve the web app until told to stop."""
    import uvicorn  # noqa: PLC0415 - each command imports what it alone needs, so that --help is instant

    from app.db import migrate  # noqa: PLC0415
    from app.learning.supervisor import Supervisor  # noqa: PLC0415
    from app.main import create_app  # noqa: PLC0415

    settings = _settings(host=host, port=port, workers=workers)
    listener = _listen(settings)
    migrate(settings)
    server = uvicorn.Server(
        uvicorn.Config(
            create_app(settings),
            log_level="warning",
            server_header=False,
            h11_max_incomplete_event_size=settings.max_body_bytes,  # so that we can say that an address is too long
            timeout_graceful_shutdown=2,  # an open stream would hold a stop forever
        )
    )
    supervisor = Supervisor(settings)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))  # uvicorn raises it once more at its end; `finally` must run
    supervisor.start()
    typer.echo(f"IRLFR is at {_address(settings)}")
    try:
        server.run(sockets=[listener])
    finally:
        supervisor.stop()


@cli.command()
def worker(
    name: Annotated[str, typer.Option(help="Unlike that of every other worker on this database.")] = "worker-1",
    follow_stdin: Annotated[  # noqa: FBT002 - a flag of the command line
        bool, typer.Option("--follow-stdin", help="Stop when standard input ends, as when the parent dies.")
    ] = False,
) -> None:
    """Take runs from the queue and learn, until told to stop."""
    from app.learning.supervisor import ONE_THREAD_EACH  # noqa: PLC0415

    if "numpy" not in sys.modules:
        os.environ.update(ONE_THREAD_EACH)
    from app.learning.worker import work  # noqa: PLC0415 - after the line above, which NumPy reads at import

    work(_settings(), name=name, follow_stdin=follow_stdin)


@cli.command()
def learn(
    file: Annotated[Path, typer.Argument(help="A demonstration file (JSON lines), as the compare page gives it.")],
    learners: Annotated[
        str | None, typer.Option(help="Names, separated by commas, or `all`; if left out, the paper's four and birlfr.")
    ] = None,
    seed: Annotated[int, typer.Option(help="For the start weights and the episodes.", min=0)] = 0,
    changed: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a setting; may be repeated.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Where to write the result (JSON); beside FILE if left out.")] = None,
) -> None:
    """Learn from a demonstration file, print the comparison and write the result."""
    from irl_core import IrlError  # noqa: PLC0415

    try:
        result = _learn(file, _names_of(learners), seed, _settings_of(changed or []))
    except (IrlError, OSError, UnicodeDecodeError) as error:
        _refuse(f"{file}: {error}")
    print_comparison(result["comparison"]["entries"])
    target = out or file.with_suffix(".result.json")
    try:
        target.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    except OSError as error:
        _refuse(f"The result could not be written: {error}")
    typer.echo(f"\nThe result is in {target}")


@cli.command()
def experiment(
    *,
    worlds: Annotated[int, typer.Option(help="Worlds for each kind of demonstrator.", min=1, max=1_000_000)] = 20,
    demonstrators: Annotated[str | None, typer.Option(help="Names, separated by commas; all if left out.")] = None,
    learners: Annotated[str | None, typer.Option(help="Names, separated by commas; all if left out.")] = None,
    seed: Annotated[int, typer.Option(help="Decides every world, attempt and episode.")] = 0,
    rows: Annotated[int, typer.Option(help="Height of the worlds.")] = 7,
    cols: Annotated[int, typer.Option(help="Width of the worlds.")] = 7,
    slip: Annotated[float, typer.Option(help="The chance that a step goes another way.")] = 0.0,
    successes: Annotated[int, typer.Option(help="Successes each demonstrator gives.")] = 3,
    failures: Annotated[int, typer.Option(help="Failures each demonstrator gives.")] = 3,
    ranking_noise: Annotated[float, typer.Option(help="Mistakes in the order, in points of reward.")] = 0.0,
    episodes: Annotated[int, typer.Option(help="Episodes each learned policy plays.")] = 50,
    changed: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a setting; may be repeated.")
    ] = None,
    processes: Annotated[int | None, typer.Option(help="One for each core if left out.", min=1, max=1024)] = None,
    out: Annotated[Path, typer.Option(help="The folder for the tables, the figure and the outcomes.")] = Path(
        "experiment"
    ),
) -> None:
    """Repeat the paper's experiment with simulated demonstrators, on as many worlds as wanted."""
    from app import experiment_command  # noqa: PLC0415
    from irl_core import LEARNERS, IrlError  # noqa: PLC0415
    from irl_core import Settings as LearnerSettings  # noqa: PLC0415
    from irl_core.demonstrators import DEMONSTRATORS  # noqa: PLC0415
    from irl_core.experiment import ExperimentSpec  # noqa: PLC0415

    try:
        spec = ExperimentSpec(
            learners=_names(learners) or tuple(LEARNERS),
            seed=seed,
            rows=rows,
            cols=cols,
            slip=slip,
            n_successes=successes,
            n_failures=failures,
            ranking_noise=ranking_noise,
            n_episodes=episodes,
            settings=LearnerSettings.from_json(_settings_of(changed or [])),
        )
        kinds = _names(demonstrators) or tuple(DEMONSTRATORS)
        n_processes = min(processes or os.cpu_count() or 1, worlds * len(kinds))
        experiment_command.run(experiment_command.Plan(spec, kinds, worlds, n_processes, out))
    except (IrlError, OSError) as error:
        _refuse(str(error))
    except KeyboardInterrupt:
        typer.echo("Stopped before the end; nothing was written.", err=True)
        raise typer.Exit(STOPPED) from None


@cli.command()
def doctor() -> None:
    """Check the environment, the database, the browser's packages and the worker, and say what to do."""
    from app.doctor import checks  # noqa: PLC0415

    settings = _settings()
    is_well = True
    for check in checks(settings):
        is_well &= check.is_well
        typer.echo(f"{'ok  ' if check.is_well else 'FAIL'}  {check.name}: {check.found}")
        if check.remedy:
            typer.echo(f"      → {check.remedy}")
    raise typer.Exit(0 if is_well else 1)


def _listen(settings: Settings) -> socket.socket:
    """Take the port before anything else is started, so that a port in use costs nothing."""
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    try:
        listener = socket.create_server((settings.host, settings.port), family=family, backlog=2048)
        # Connections inherit it. Without it the second half of an answer waits 40 ms for the first half's receipt:
        # asyncio sees to that only on sockets that name their protocol, which those made here do not.
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    except OSError as error:
        _refuse(
            f"Cannot listen on {_address(settings)}: {error.strerror}.\n"
            f"Another server may be running there; choose another port: irlfr serve --port {settings.port + 1}"
        )
    return listener


def _address(settings: Settings) -> str:
    host = f"[{settings.host}]" if ":" in settings.host else settings.host
    return f"http://{host}:{settings.port}"


def _learn(file: Path, names: list[str], seed: int, changed: Mapping[str, Any]) -> dict[str, Any]:
    """Do what a run of the web app does, without the web app."""
    import irl_core  # noqa: PLC0415

    read = irl_core.read_demonstration_file(file)
    problem = irl_core.LearningProblem.build(
        read.world, read.demonstrations, read.rankings, settings=irl_core.Settings.from_json(changed), seed=seed
    )
    results = [irl_core.learn(irl_core.LEARNERS[name], problem) for name in names]
    comparison = irl_core.compare(read.world, read.demonstrations, results, seed=seed).to_json()
    return {
        "file": file.name,
        "seed": seed,
        "settings": problem.settings.to_json(),
        "learners": {name: result.to_json() for name, result in zip(names, results, strict=True)},
        "rollouts": comparison.pop("rollouts"),
        "comparison": comparison,
    }


def _names_of(learners: str | None) -> list[str]:
    """Read `--learners`."""
    from irl_core import DEFAULT_LEARNERS, LEARNERS  # noqa: PLC0415

    if learners is None or learners.strip() == "all":
        return list(DEFAULT_LEARNERS if learners is None else LEARNERS)
    names = [name.strip() for name in learners.split(",")]
    unknown = [name for name in names if name not in LEARNERS]
    if unknown:
        _refuse(f"There is no learner {unknown[0]!r}; there are {', '.join(LEARNERS)}.")
    return names


def _names(listed: str | None) -> tuple[str, ...]:
    """Names separated by commas, each once."""
    return tuple(dict.fromkeys(name.strip() for name in (listed or "").split(",") if name.strip()))


def _settings_of(changed: list[str]) -> dict[str, Any]:
    """Read `--set name=value`: a number where it looks like one."""
    settings: dict[str, Any] = {}
    for one in changed:
        name, equals, value = one.partition("=")
        if not equals:
            _refuse(f"--set {one!r} lacks its value; write --set name=value.")
        try:
            settings[name] = json.loads(value)
        except ValueError:
            settings[name] = value
    return settings


def print_comparison(entries: list[dict[str, Any]]) -> None:
    """Print a table, best first."""
    from rich.console import Console  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    table = Table("place", "who", "mean of episodes", "± s.e.", "expected", "greedy", "of optimum", "episodes")
    for column in table.columns[2:]:
        column.justify = "right"
    for entry in entries:
        table.add_row(
            str(entry["place"]),
            entry["title"],
            _figure(entry["mean_return"]),
            _figure(entry["standard_error"]),
            _figure(entry["expected_return"]),
            _figure(entry["greedy_return"]),
            "–" if entry["share_of_optimum"] is None else f"{entry['share_of_optimum']:.0%}",
            str(entry["episodes"]),
        )
    Console(width=100 if not sys.stdout.isatty() else None).print(table)


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.2f}"


def _settings(**given: Any) -> Settings:  # noqa: ANN401 - any field of Settings
    try:
        return Settings(**{name: value for name, value in given.items() if value is not None})
    except ValidationError as error:
        lines = [f"IRLFR_{'_'.join(map(str, one['loc'])).upper()}: {one['msg']}" for one in error.errors()]
        _refuse("The settings cannot be used.\n" + "\n".join(lines))


def _refuse(message: str) -> NoReturn:
    typer.echo(message, err=True)
    raise typer.Exit(BAD_INPUT)


if __name__ == "__main__":
    main()
