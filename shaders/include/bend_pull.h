// Returns the pull on a particle by the elements whose tangents it defines (rest_bend.h), in cloth that rests bent:
// these elements turn with it. The includer has include/bend_target.h and include/rest_bend.h.
vec3 bend_pull(ivec2 texel) {
    ivec2 left = texel - ivec2(1, 0), up = texel - ivec2(0, 1), last = push.grid - 1;
    vec4 shares = LOAD(spring_shares, texel);
    float acts_left = 0.0f, acts_up = 0.0f, acts_right = 0.0f, acts_down = 0.0f;
    if (texel.x > 0) acts_left = LOAD(spring_shares, left).x > 0.0f ? 1.0f : 0.0f;
    if (texel.y > 0) acts_up = LOAD(spring_shares, up).y > 0.0f ? 1.0f : 0.0f;
    if (texel.x < last.x) acts_right = shares.x > 0.0f ? 1.0f : 0.0f;
    if (texel.y < last.y) acts_down = shares.y > 0.0f ? 1.0f : 0.0f;
    precise float own_row = acts_left - acts_right;
    precise float own_column = acts_up - acts_down;
    precise float of_right = -acts_right;
    precise float of_below = -acts_down;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    sum = add_pull_of(sum, bend_part(texel, bend_pull_row), own_row);
    sum = add_pull_of(sum, bend_part(texel, bend_pull_column), own_column);
    if (texel.x > 0) sum = add_pull_of(sum, bend_part(left, bend_pull_row), acts_left);
    if (texel.x < last.x) sum = add_pull_of(sum, bend_part(texel + ivec2(1, 0), bend_pull_row), of_right);
    if (texel.y > 0) sum = add_pull_of(sum, bend_part(up, bend_pull_column), acts_up);
    if (texel.y < last.y) sum = add_pull_of(sum, bend_part(texel + ivec2(0, 1), bend_pull_column), of_below);
    // The cells, by which of their corners the particle is; cells that the grid lacks are skipped.
    sum = add_pull_of(sum, bend_part(texel, twist_pull_row), -1.0f);
    sum = add_pull_of(sum, bend_part(texel, twist_pull_column), -1.0f);
    if (texel.x > 0) {
        sum = add_pull_of(sum, bend_part(left, twist_pull_row), 1.0f);
        sum = add_pull_of(sum, bend_part(left, twist_pull_column), -1.0f);
    }
    if (texel.y > 0) {
        sum = add_pull_of(sum, bend_part(up, twist_pull_row), -1.0f);
        sum = add_pull_of(sum, bend_part(up, twist_pull_column), 1.0f);
    }
    if (texel.x > 0 && texel.y > 0) {
        sum = add_pull_of(sum, bend_part(left - ivec2(0, 1), twist_pull_row), 1.0f);
        sum = add_pull_of(sum, bend_part(left - ivec2(0, 1), twist_pull_column), 1.0f);
    }
    return sum;
}
