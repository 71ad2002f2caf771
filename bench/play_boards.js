// Six boards of 100×100 on one page: every agent moves in every frame, every heat map is painted anew ten times a second.
async ({ seconds, world }) => {
  await import("#js/elements/irl-board.js");
  const n = world.rows;
  const grid = document.createElement("div");
  grid.style.cssText = "display: grid; grid-template-columns: repeat(3, 1fr); gap: 8px; inline-size: 1264px";
  document.body.replaceChildren(grid);
  const boards = Array.from({ length: 6 }, () => grid.appendChild(document.createElement("irl-board")));
  for (const board of boards) board.world = world;
  const heats = Array.from({ length: 20 }, (_, k) =>
    Float64Array.from({ length: n * n }, (_, s) => Math.sin(s / 97 + k)),
  );
  // Along a row and back, then the next row: a step of one square in every frame.
  const stateAt = (k) => (Math.floor(k / n) % n) * n + (Math.floor(k / n) % 2 ? n - 1 - (k % n) : k % n);
  await new Promise((resolve) => setTimeout(resolve, 500));

  const frames = [];
  const work = [];
  const channel = new MessageChannel();
  let began = 0;
  channel.port1.onmessage = () => work.push(performance.now() - began);
  await new Promise((resolve) => {
    let [first, last, painted] = [0, 0, 0];
    requestAnimationFrame(function draw(now) {
      first ||= now;
      if (last) frames.push(now - last);
      last = now;
      began = performance.now();
      channel.port2.postMessage(null);
      const isHot = now - painted >= 95;
      if (isHot) painted = now;
      const k = frames.length;
      boards.forEach((board, i) => {
        const heat = isHot ? { values: heats[(k + i) % heats.length], scale: [-1, 1] } : {};
        board.view = { ...board.view, ...heat, agents: [{ state: stateAt(k + i * 7), who: "human", facing: 1 }] };
      });
      if (now - first < 1000 * seconds) requestAnimationFrame(draw);
      else resolve();
    });
  });
  return { frames, work, side: boards[0].cell * n, nAgents: document.querySelectorAll(".agent").length };
};
