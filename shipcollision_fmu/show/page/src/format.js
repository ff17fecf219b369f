// Numbers for people: a fixed number of digits, a true minus sign, a dash for what is not known.

const MINUS = "\u2212";

export function number(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const text = value.toFixed(digits);
  return Number(text) < 0 ? MINUS + text.slice(1) : text.replace("-", "");
}

/** Seconds as 0:07.25, with as many digits as the run's length wants. */
export function clockTime(seconds, digits) {
  const sign = seconds < 0 ? MINUS : "";
  const whole = Math.abs(seconds).toFixed(digits);
  const minutes = Math.floor(Number(whole) / 60);
  const rest = (Number(whole) - 60 * minutes).toFixed(digits).padStart(digits ? digits + 3 : 2, "0");
  return `${sign}${minutes}:${rest}`;
}

export const degrees = (radians) => (radians === null ? null : (radians * 180) / Math.PI);

/** A heading [deg], which counts whole turns, as a compass shows it: in [0, 360) when it has so many digits. */
export const compass = (heading, digits) => ((Number(heading.toFixed(digits)) % 360) + 360) % 360;
