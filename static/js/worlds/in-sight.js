/** Keeps the board in sight while it is played, in windows that do not hold the whole page: zoomed in, small, turned. */

const ENOUGH = 0.98;

/**
 * Returns what brings the board into sight unless it is known to be there.
 * @param {Element} board @param {AbortSignal} signal
 */
export function keepInSight(board, signal) {
  let isInSight = false;
  // Watched rather than measured: a measure at each key press would cost a layout.
  const watch = new IntersectionObserver(
    (entries) => {
      isInSight = (entries.at(-1)?.intersectionRatio ?? 1) >= ENOUGH;
    },
    { threshold: [ENOUGH] },
  );
  watch.observe(board);
  signal.addEventListener("abort", () => watch.disconnect());
  return () => {
    if (!isInSight) board.scrollIntoView({ block: "nearest", inline: "nearest" });
  };
}
