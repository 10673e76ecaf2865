
// To surface.frag: the radiance of each pixel by its own normal and view. With seen_normal.glsl.

in vec3 v_tangent;
in vec3 v_shadow;

void see(out vec3 n, out vec3 to_eye);
void reflect_light(vec3 n, vec3 tangent, vec3 to_eye, out vec3 plain, out vec3 tinted);

vec3 radiance_of(vec3 base_color) {
  vec3 n, to_eye, plain, tinted;
  see(n, to_eye);
  reflect_light(n, v_tangent, to_eye, plain, tinted);
  return v_shadow * (plain + base_color * tinted);
}
