// The motion of a complex shape.

/** The displacements at a phase: Re(u e^{iφ}) of [re x, im x, re y, …] a point; the largest amplitude of the shape is 1. */
export function displacements(shape, phase) {
  const largest = Math.max(1e-300, ...shape.map((u) => Math.hypot(...u)));
  const [c, s] = [Math.cos(phase), Math.sin(phase)];
  return shape.map((u) => [0, 1, 2].map((k) => (u[2 * k] * c - u[2 * k + 1] * s) / largest));
}
