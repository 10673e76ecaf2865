
// To surface.frag: radiance base colour / pi · E(n), of a Lambertian surface that sees the whole distant light,
// or so much of it as v_shadow says.

in vec3 v_normal;
in vec3 v_shadow;

const float kInversePi = 0.318309886;

vec3 eval_sh(vec3 n);  // irradiance

vec3 radiance_of(vec3 base_color) {
  // Interpolation shortens a normal; one of length zero stays finite.
  vec3 n = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-20));
  return kInversePi * v_shadow * base_color * eval_sh(gl_FrontFacing ? n : -n);
}
