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

/** An outbox that is kept in memory. @returns {import("#js/lib/parcels.js").Store} */
export function memoryParcels() {
  /** @type {Map<number, import("#js/lib/parcels.js").Parcel>} */
  const kept = new Map();
  let last = 0;
  return {
    async add(parcel) {
      for (const [seq, { id }] of kept) if (id === parcel.id) kept.delete(seq);
      last += 1;
      kept.set(last, { ...parcel, seq: last });
      return { ...parcel, seq: last };
    },
    async refuse(parcel) {
      if (kept.has(Number(parcel.seq))) kept.set(Number(parcel.seq), parcel);
    },
    delete: async (parcel) => void kept.delete(Number(parcel.seq)),
    all: async () => [...kept.values()],
  };
}
