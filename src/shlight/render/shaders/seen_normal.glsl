
// The unit normal of the side of a surface that is seen, and the way to the eye, of any length.

in vec3 v_normal;
in vec3 v_to_eye;
flat in vec3 v_normal_nearby;  // of a vertex of the triangle
flat in vec3 v_to_eye_nearby;

void see(out vec3 n, out vec3 to_eye) {
  // At outlines, the middle of a pixel may lie far outside of a sliver of a triangle, where interpolation goes on to
  // anything, and would sparkle. Within the triangle it makes unit normals shorter, never longer: so it can be told.
  bool outside = dot(v_normal, v_normal) > 1.5;
  n = outside ? v_normal_nearby : v_normal;
  to_eye = outside ? v_to_eye_nearby : v_to_eye;
  float nearby = dot(v_normal_nearby, v_to_eye_nearby);
  // Of a surface seen from behind that is the other side. But at the outline of a closed one, depth may be too coarse to
  // hide its far side, whose normals are nearly edge-on: there they stay.
  if (!gl_FrontFacing && nearby < 0.0 && nearby * nearby > 0.004 * dot(v_to_eye_nearby, v_to_eye_nearby)) n = -n;
  // What points away from the eye all the same is turned back to where the surface is edge-on.
  n -= min(dot(n, to_eye), 0.0) / dot(to_eye, to_eye) * to_eye;
  // A normal of length zero stays finite.
  n *= inversesqrt(max(dot(n, n), 1e-20));
}
