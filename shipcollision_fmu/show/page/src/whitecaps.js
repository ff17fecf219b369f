// How much of the sea a wind makes white, and which crests break for that. Numbers only.

const MOST = 0.08; // of the water, as in a gale of 18 m/s: beyond that whole crests are torn off
const FEWEST = 1e-5; // and below this there is not one in the picture

/** Share of the water that is white at a wind [m/s]. Source: Monahan and O'Muircheartaigh, J. Phys. Oceanogr. 10 (1980). */
export const coverageOf = (wind) => Math.min(MOST, 3.84e-6 * Math.max(0, wind) ** 3.41);

/**
 * Height, in standard deviations, that normally distributed heights exceed on a share of the water below a half; Infinity
 * where nothing breaks. Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.22, to 0.003.
 */
export function breakingHeight(coverage) {
  if (coverage < FEWEST) return Infinity;
  const t = Math.sqrt(-2 * Math.log(coverage));
  return t - (2.30753 + 0.27061 * t) / (1 + 0.99229 * t + 0.04481 * t * t);
}
