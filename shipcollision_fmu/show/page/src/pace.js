// Keeps the pace of a picture that a processor draws: while the run plays, pictures that take too long get fewer pixels,
// and more again once there is time for them. No single picture counts, however long it took: the page may have been
// hidden, or the machine asleep. Several in a row count, even of seconds each.

const SLOW = 36; // a picture that takes longer [ms] is too slow for thirty in a second
const AIM = 30; // what a picture should take [ms] after its pixels have become fewer
const QUICK = 22; // pictures that take less [ms] leave time for more pixels
const LEAST = 0.35; // share of the pixels in each direction that is kept at least
const FRAMES = 3; // so many slow pictures one after the other are no accident
const LONG = 150; // and fewer are none that take so long together [ms]
const PATIENCE = { first: 45, most: 1500 }; // quick pictures before more pixels are tried
const STEPS = { fewest: 0.5, most: 0.9, up: 1.15 }; // by how much the share changes at once

export function makePace() {
  let isPlaying = false, last = NaN, kept = 1;
  let slow = [], quick = 0, patience = PATIENCE.first, sinceRaised = Infinity;

  function forget() {
    slow = [];
    quick = 0;
  }

  /** Fewer pixels, by the quickest of the slow pictures. Where more have just been tried, they are not for long. */
  function lower() {
    const took = Math.min(...slow);
    forget();
    if (kept <= LEAST) return false;
    if (sinceRaised < PATIENCE.first) patience = Math.min(PATIENCE.most, 2 * patience);
    sinceRaised = Infinity;
    kept = Math.max(LEAST, kept * Math.min(STEPS.most, Math.max(STEPS.fewest, Math.sqrt(AIM / took))));
    return true;
  }

  function raise() {
    forget();
    if (kept >= 1) return false;
    sinceRaised = 0;
    kept = Math.min(1, STEPS.up * kept);
    return true;
  }

  return {
    /** Of the screen's pixels in each direction, how many are drawn now. */
    get share() {
      return isPlaying ? kept : 1;
    },
    /** Takes the time [ms] at which a picture begins; whether `share` has changed. */
    next(now) {
      const took = now - last;
      last = now;
      if (!isPlaying || Number.isNaN(took)) return false;
      sinceRaised++;
      if (took <= SLOW) {
        slow = [];
        quick = took < QUICK ? quick + 1 : 0;
        return quick >= patience && raise();
      }
      quick = 0;
      slow.push(took);
      const isLong = slow.length > 1 && Math.min(...slow) * slow.length > LONG;
      return (slow.length >= FRAMES || isLong) && lower();
    },
    /** Whether `share` has changed. */
    setPlaying(playing) {
      if (playing === isPlaying) return false;
      isPlaying = playing;
      last = NaN; // from now on
      forget();
      return kept < 1;
    },
  };
}
