// Watches key presses on the play page: when the key went down, and when the frame that shows the agent on its way was done.
(() => {
  const AXES = { ArrowUp: [0, -1], ArrowRight: [1, 0], ArrowDown: [0, 1], ArrowLeft: [-1, 0] };
  const presses = [];
  const events = [];
  const agent = () => document.querySelector("#board .agent");
  const channel = new MessageChannel();
  const waiting = [];
  channel.port1.onmessage = () => {
    const press = waiting.shift();
    press.frameMs = performance.now() - press.at;
  };

  // In a frame's callbacks, the page's own before ours: has the agent's box gone the way of the key?
  function look(press, before, [right, down], nFrames) {
    const box = agent().getBoundingClientRect();
    const hasMoved = (box.x - before.x) * right + (box.y - before.y) * down > 0.5;
    if (hasMoved || nFrames > 120) {
      press.nFrames = hasMoved ? nFrames : null;
      press.state = Number(agent().dataset.state);
      press.nPressed = presses.length; // a frame that is late shows the presses after it too
      waiting.push(press);
      channel.port2.postMessage(null); // answered right after this frame
    } else requestAnimationFrame(() => look(press, before, [right, down], nFrames + 1));
  }

  addEventListener(
    "keydown",
    (event) => {
      const axis = AXES[event.key];
      if (!axis || !event.isTrusted) return;
      const before = agent().getBoundingClientRect();
      const press = { at: event.timeStamp, state: null, nPressed: null, nFrames: null, frameMs: null };
      presses.push(press);
      // Heard last, so that the page's callback for the next frame stands before ours.
      addEventListener("keydown", () => requestAnimationFrame(() => look(press, before, axis, 1)), { once: true });
    },
    { capture: true },
  );
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) if (entry.name === "keydown") events.push(entry.duration);
  }).observe({ type: "event", durationThreshold: 16 });

  window.pressesSeen = () => ({ presses, events });
})();
