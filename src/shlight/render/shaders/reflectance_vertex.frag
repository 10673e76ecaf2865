
// To surface.frag: the radiance that reflectance_vertex.vert has found, interpolated between vertices.

in vec3 v_plain;
in vec3 v_tinted;

vec3 radiance_of(vec3 base_color) { return v_plain + base_color * v_tinted; }
