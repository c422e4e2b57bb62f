// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/presses.hpp"

#include <array>

namespace hapnet::lab {

std::span<const Press> presses_of(device::Task task)
{
    static constexpr std::array<Press, 6> in_t2{{{0, 0.5, 1.0, 7.0},
                                                 {0, 1.0, 7.0, 10.0},
                                                 {0, 2.0, 10.0, 13.0},
                                                 {1, 0.5, 14.0, 20.0},
                                                 {1, 1.0, 20.0, 23.0},
                                                 {1, 2.0, 23.0, 26.0}}};
    if (device::name_of(task) == "T2") return in_t2;
    return {};
}

} // namespace hapnet::lab
