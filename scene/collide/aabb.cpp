// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/aabb.hpp"

namespace hapnet::scene {

AabbScan::AabbScan(std::span<const Aabb> boxes) : size_{static_cast<BodyId>(boxes.size())}
{
    for (std::vector<double>& lane : lanes_)
        lane.assign((boxes.size() + block - 1) / block * block, 0.0);
    for (BodyId id = 0; id < size_; ++id) move(id, boxes[id]);
}

void AabbScan::move(BodyId id, const Aabb& box)
{
    for (int axis = 0; axis < 3; ++axis) {
        const auto lane = static_cast<std::size_t>(axis);
        lanes_[lane][id] = box.low[axis];
        lanes_[lane + 3][id] = box.high[axis];
    }
}

void AabbScan::compare(const Aabb& box, BodyId first, std::array<std::uint64_t, block>& apart) const
{
    const double* const low_x = lanes_[0].data() + first;
    const double* const low_y = lanes_[1].data() + first;
    const double* const low_z = lanes_[2].data() + first;
    const double* const high_x = lanes_[3].data() + first;
    const double* const high_y = lanes_[4].data() + first;
    const double* const high_z = lanes_[5].data() + first;
    for (BodyId i = 0; i < block; ++i) {
        const bool x =
            static_cast<int>(low_x[i] > box.high.x) | static_cast<int>(high_x[i] < box.low.x);
        const bool y =
            static_cast<int>(low_y[i] > box.high.y) | static_cast<int>(high_y[i] < box.low.y);
        const bool z =
            static_cast<int>(low_z[i] > box.high.z) | static_cast<int>(high_z[i] < box.low.z);
        apart[i] = static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) |
                   static_cast<std::uint64_t>(z);
    }
}

} // namespace hapnet::scene
