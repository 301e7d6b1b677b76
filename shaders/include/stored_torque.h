// Stores a workgroup's sum of torques. The includer has `torques` and `push.sum_count`.
void store_sum(int group, TorqueSum sum) {
    int row = int(cloth_place()) * push.sum_count + group;
    imageStore(torques, ivec2(0, row), sum.moment);
    imageStore(torques, ivec2(1, row), sum.impulse);
    imageStore(torques, ivec2(2, row), sum.torque);
    imageStore(torques, ivec2(3, row), sum.products);
}
