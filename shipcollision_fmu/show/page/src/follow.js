// What follows the clock beside the picture. A browser without a graphics card takes as long for a plot as for the picture:
// while a plain picture plays, numbers and plots are shown some times a second.

/** Whether what was shown at `last` [ms] may wait: a plain picture plays, and `gap` [ms] is not over. */
export const mayWait = (clock, last, gap) => clock.playing && document.body.classList.contains("plain") && performance.now() - last < gap;

/** Calls `show` in the next frame after the clock has changed, while a plain picture plays at most once in `gap` [ms]. */
export function follow(clock, show, gap) {
  let isAsked = false, last = -Infinity;
  clock.watch(() => {
    if (isAsked || mayWait(clock, last, gap)) return;
    isAsked = true;
    requestAnimationFrame((now) => {
      isAsked = false;
      last = now;
      show();
    });
  });
}
