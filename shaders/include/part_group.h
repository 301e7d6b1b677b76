// Solves systems in parts among the invocations of a workgroup (part_rows.h). Subgroups are full; each has parts of
// `part_lines` systems, side by side, in `lanes` invocations each, which have `part_particles` rows each. Each
// invocation eliminates all of its rows but the last; a subgroup eliminates these last rows, except its own last one,
// by shuffles; and every subgroup solves the remaining rows of all subgroups, by shuffles too. The workgroup waits once
// for that.
layout(constant_id = 3) const int subgroup_lanes = 8;
const int lanes = subgroup_lanes / part_lines;
const int groups =
    int(gl_WorkGroupSize.x) / subgroup_lanes;  // subgroups that have parts of one system, `lanes` at most

int lane, group;  // this invocation's place in its part of the system, and that part's number
int first_lane;   // the invocation of the subgroup with place 0
int system;       // which of the subgroup's systems it is
int group_at;     // index of the part's data in shared arrays; those of a system follow each other

CyclicRow row[part_particles];  // this invocation's rows
vec3 solution[part_particles];  // and their solutions
vec3 solution_before;           // the solution before them

shared vec4 first_rows[groups * part_lines], last_rows[groups * part_lines];
shared vec2 first_right[groups * part_lines], last_right[groups * part_lines];

void take_group_places() {
    int in_subgroup = int(gl_SubgroupInvocationID);
    lane = in_subgroup % lanes;
    first_lane = in_subgroup - lane;
    group = int(gl_SubgroupID);
    system = in_subgroup / lanes;
    group_at = system * groups + group;
}

float from_lane(float value, int at) { return subgroupShuffle(value, uint(first_lane + at)); }
vec3 from_lane(vec3 value, int at) { return subgroupShuffle(value, uint(first_lane + at)); }

/// `wide`: the right-hand side has three components; otherwise only the first counts.
CyclicRow from_lane(CyclicRow from, int at, const bool wide) {
    vec3 right;
    if (wide)
        right = from_lane(from.right, at);
    else
        right = vec3(from_lane(from.right.x, at), 0.0f, 0.0f);
    return CyclicRow(from_lane(from.shift, at), from_lane(from.before, at), from_lane(from.after, at), right);
}

void keep_first(CyclicRow kept, const bool wide) {
    first_rows[group_at] = vec4(kept.shift, kept.before, kept.after, kept.right.x);
    if (wide) first_right[group_at] = kept.right.yz;
}
void keep_last(CyclicRow kept, const bool wide) {
    last_rows[group_at] = vec4(kept.shift, kept.before, kept.after, kept.right.x);
    if (wide) last_right[group_at] = kept.right.yz;
}
CyclicRow kept_first(int at, const bool wide) {
    vec4 kept = first_rows[at];
    return CyclicRow(kept.x, kept.y, kept.z, vec3(kept.w, wide ? first_right[at] : vec2(0.0f, 0.0f)));
}
CyclicRow kept_last(int at, const bool wide) {
    vec4 kept = last_rows[at];
    return CyclicRow(kept.x, kept.y, kept.z, vec3(kept.w, wide ? last_right[at] : vec2(0.0f, 0.0f)));
}

void eliminate_before(const int j) {
    row[j - 1] = normalised_row(row[j - 1]);
    row[j] = without_before(row[j], row[j - 1]);
}

/// Eliminates, from the last rows of this part's invocations, all of the part's others, except that of the last
/// invocation. Returns them normalised.
CyclicRow reduced_in_subgroup(CyclicRow own, const bool wide) {
    const int last = lanes - 1;
    for (int distance = 1; distance < last; distance *= 2) {
        CyclicRow normal = normalised_row(own);
        CyclicRow before = from_lane(normal, max(lane - distance, 0), wide);
        CyclicRow after = from_lane(normal, min(lane + distance, last), wide);
        if (lane >= distance && lane < last) own = without_before(own, before);
        if (lane + distance < last) own = without_after(own, after);
    }
    return lane < last ? normalised_row(own) : own;
}

/// Returns the last unknown of the part whose number in the system is this invocation's, from what the parts stored.
vec3 last_unknown(const bool wide) {
    int of_system = group_at - group;
    CyclicRow own = no_cyclic_row();
    if (lane < groups) own = kept_last(of_system + lane, wide);
    if (lane + 1 < groups) own = without_after(own, kept_first(of_system + lane + 1, wide));
    for (int distance = 1; distance < groups; distance *= 2) {
        CyclicRow normal = normalised_row(own);
        CyclicRow before = from_lane(normal, max(lane - distance, 0), wide);
        CyclicRow after = from_lane(normal, min(lane + distance, lanes - 1), wide);
        if (lane >= distance) own = without_before(own, before);
        if (lane + distance < groups) own = without_after(own, after);
    }
    return cyclic_solution(own);
}

/// Substitutes: eliminated rows refer to the unknown before this invocation's rows as `before`.
void substitute(const int j) { solution[j] = part_solution(row[j], solution_before, solution[j + 1]); }

void join_first(inout CyclicRow first, const int j) { first = joined_row(row[j], first); }

/// Solves the system of all `row`s. Every invocation of the workgroup must call this.
void solve(const bool wide) {
    const int last = lanes - 1;
    eliminate_before(1);
    eliminate_before(2);
    eliminate_before(3);
    eliminate_before(4);
    eliminate_before(5);
    eliminate_before(6);
    eliminate_before(7);
    CyclicRow first = row[6];  // of the first unknown, between the previous invocation's last one and this one's
    join_first(first, 5);
    join_first(first, 4);
    join_first(first, 3);
    join_first(first, 2);
    join_first(first, 1);
    join_first(first, 0);
    CyclicRow own = row[7], next = from_lane(first, min(lane + 1, last), wide);
    if (lane < last) own = without_after(own, next);
    own = reduced_in_subgroup(own, wide);
    CyclicRow before = from_lane(own, max(lane - 1, 0), wide);
    if (lane == 0) keep_first(joined_row(first, own), wide);
    if (lane == last) keep_last(without_before(own, before), wide);
    barrier();
    vec3 unknown = last_unknown(wide);
    vec3 of_part_before = from_lane(unknown, max(group - 1, 0)), of_part = from_lane(unknown, group);
    if (group == 0) of_part_before = vec3(0.0f, 0.0f, 0.0f);
    solution[7] = lane == last ? of_part : part_solution(own, of_part_before, of_part);
    solution_before = from_lane(solution[7], max(lane - 1, 0));
    if (lane == 0) solution_before = of_part_before;
    substitute(6);
    substitute(5);
    substitute(4);
    substitute(3);
    substitute(2);
    substitute(1);
    substitute(0);
}
