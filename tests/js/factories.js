/** A world from its rewards: the goal is the last square. @param {number[][]} rewards @param {object} [more] */
export function makeWorld(rewards, more = {}) {
  const [rows, cols] = [rewards.length, rewards[0].length];
  const goal = rows * cols - 1;
  const walls = more.walls ?? [];
  const colourOf = (state, reward) =>
    walls.includes(state) ? "wall" : state === goal ? "goal" : reward < -1 ? "red" : "blue";
  return {
    id: "world",
    rows,
    cols,
    start: 0,
    goal,
    goals: [goal],
    walls,
    rewards,
    colours: rewards.map((row, r) => row.map((reward, c) => colourOf(r * cols + c, reward))),
    seed: 1,
    red_probability: 0.3,
    slip: 0,
    horizon: 50,
    time_limit_s: null,
    ...more,
  };
}
