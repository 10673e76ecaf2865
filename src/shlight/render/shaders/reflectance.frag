
// To surface.frag: the radiance of each pixel by its own normal and view.

in vec3 v_normal;
in vec3 v_tangent;
in vec3 v_to_eye;
in vec3 v_shadow;

void reflect_light(vec3 n, vec3 tangent, vec3 to_eye, out vec3 plain, out vec3 tinted);

vec3 radiance_of(vec3 base_color) {
  // Interpolation shortens a normal; one of length zero stays finite.
  vec3 n = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-20)), plain, tinted;
  reflect_light(gl_FrontFacing ? n : -n, v_tangent, v_to_eye, plain, tinted);
  return v_shadow * (plain + base_color * tinted);
}
