
// The unit normal of the side of a surface that is seen.

in vec3 v_normal;
in vec3 v_to_eye;

vec3 seen_normal() {
  vec3 n = gl_FrontFacing ? v_normal : -v_normal;
  // At outlines, the middle of a pixel may lie far outside of a sliver of a triangle. The normal found there points away
  // from the eye, anywhere, and would sparkle: it is turned back to where the surface is edge-on.
  n -= min(dot(n, v_to_eye), 0.0) / dot(v_to_eye, v_to_eye) * v_to_eye;
  // Interpolation shortens a normal; one of length zero stays finite.
  return n * inversesqrt(max(dot(n, n), 1e-20));
}
