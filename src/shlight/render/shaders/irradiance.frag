
// To surface.frag: radiance base colour / pi · E(n), of a Lambertian surface that sees the whole distant light,
// or so much of it as v_shadow says. With seen_normal.glsl.

in vec3 v_shadow;

const float kInversePi = 0.318309886;

void see(out vec3 n, out vec3 to_eye);
vec3 eval_sh(vec3 n);  // irradiance

vec3 radiance_of(vec3 base_color) {
  vec3 n, to_eye;
  see(n, to_eye);
  return kInversePi * v_shadow * base_color * eval_sh(n);
}
