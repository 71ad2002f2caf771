// Times what a person waits for on the Learn, Compare and Rank pages: from a trusted press to the end of the frame that shows the answer.
(() => {
  const LONGEST_MS = 60_000;
  const channel = new MessageChannel();
  const ends = [];
  channel.port1.onmessage = () => ends.shift()();

  const nextFrame = () => new Promise(requestAnimationFrame);

  // A message sent from a frame's callbacks is heard right after that frame.
  function endOfFrame() {
    return new Promise((resolve) => {
      ends.push(() => resolve(performance.now()));
      channel.port2.postMessage(null);
    });
  }

  function pressed(type, selector) {
    return new Promise((resolve) => {
      const hear = (event) => {
        if (!event.isTrusted || !event.target.closest(selector)) return;
        removeEventListener(type, hear, { capture: true });
        resolve(event.timeStamp);
      };
      addEventListener(type, hear, { capture: true });
    });
  }

  // Milliseconds since `at`, once the page says so and `nFrames` more have passed.
  async function shownAfter(at, isThere, nFrames) {
    const latest = performance.now() + LONGEST_MS;
    while (!isThere()) {
      if (performance.now() > latest) throw new Error("what was waited for was never shown");
      await nextFrame();
    }
    for (let n = 0; n < nFrames; n++) await nextFrame();
    return (await endOfFrame()) - at;
  }

  // The page gives its boards what to paint in one frame, and they paint in the next.
  window.watchLearning = () => {
    window.watched = pressed("pointerdown", '[data-action="learn"]').then(async (at) => {
      const page = document.querySelector("learn-page");
      const frame = await shownAfter(at, () => Number(page.dataset.frames) > 0, 1);
      const done = await shownAfter(at, () => ["done", "failed"].includes(page.dataset.status), 1);
      return { status: page.dataset.status, pressedAt: performance.timeOrigin + at, frame, done };
    });
  };

  window.comparisonShownAfter = (pressedAt, nRows) => {
    const isThere = () => document.querySelectorAll(".result-table tbody tr").length >= nRows;
    return shownAfter(pressedAt - performance.timeOrigin, isThere, 1);
  };

  // The board is given its policy between two frames, and paints in the next.
  window.watchDrop = () => {
    const { dataset } = document.querySelector("#policy");
    const before = dataset.shown;
    window.watched = pressed("pointerup", "html").then((at) => shownAfter(at, () => dataset.shown !== before, 0));
  };
})();
