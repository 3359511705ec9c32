// The little plane geometry that the support polygon needs. Points are [x, z].

// Convex hull, counter-clockwise (Andrew's monotone chain).
export function convexHull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], p) <= 0) chain.pop();
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

// Outline of a shoe on the ground from ankle and ball of the foot (Vector3).
export function soleOutline(ankle, ball) {
  const dx = ball.x - ankle.x;
  const dz = ball.z - ankle.z;
  const length = Math.hypot(dx, dz);
  if (length < 1e-4) return [];
  const [fx, fz] = [dx / length, dz / length];
  const corner = (along, across, from) => [from.x + fx * along - fz * across, from.z + fz * along + fx * across];
  return [
    corner(-0.06, 0.028, ankle), corner(-0.06, -0.028, ankle),
    corner(0, 0.045, ball), corner(0, -0.045, ball),
    corner(0.07, 0.025, ball), corner(0.07, -0.025, ball),
  ];
}
