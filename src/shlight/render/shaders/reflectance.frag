
// To surface.frag: the radiance of each pixel by its own normal and view. With seen_normal.glsl.

in vec3 v_tangent;
in vec3 v_shadow;

vec3 seen_normal();
void reflect_light(vec3 n, vec3 tangent, vec3 to_eye, out vec3 plain, out vec3 tinted);

vec3 radiance_of(vec3 base_color) {
  vec3 plain, tinted;
  reflect_light(seen_normal(), v_tangent, v_to_eye, plain, tinted);
  return v_shadow * (plain + base_color * tinted);
}
