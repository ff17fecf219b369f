// Keeps the pace of a picture that a processor draws: while the run plays, pictures that take too long get fewer pixels.

const SLOW = 36; // a picture that takes longer [ms] is too slow for thirty in a second
const LEAST = 0.5; // share of the pixels in each direction that is kept at least
const FRAMES = 3; // so many slow pictures one after the other are no accident

export function makePace() {
  let isPlaying = false, last = 0, slow = 0, kept = 1;
  return {
    /** Of the screen's pixels in each direction, how many are drawn now. */
    get share() {
      return isPlaying ? kept : 1;
    },
    /** Takes the time [ms] at which a picture begins; whether `share` has changed. */
    next(now) {
      const took = now - last;
      last = now;
      if (!isPlaying || took > 1000) return false;
      slow = took > SLOW ? slow + 1 : 0;
      if (slow < FRAMES || kept <= LEAST) return false;
      slow = 0;
      kept = Math.max(LEAST, 0.75 * kept);
      return true;
    },
    /** Whether `share` has changed. */
    setPlaying(playing) {
      const changed = playing !== isPlaying && kept < 1;
      isPlaying = playing;
      slow = 0;
      return changed;
    },
  };
}
