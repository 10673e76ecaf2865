
// To surface.frag: radiance as transfer.vert has it, interpolated between vertices.

in vec3 v_radiance;

vec3 radiance_of(vec3 base_color) { return base_color * v_radiance; }
