// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/trace.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::lab {

/// What the columns of a replay are: time, and of each side the places of the cube and of the hand
/// in mm and the force on the hand along x in N.
inline constexpr std::string_view replay_header =
    "time_s,lx,ly,lz,lhx,lhy,lhz,lfx,rx,ry,rz,rhx,rhy,rhz,rfx";

/// Every so many of a trace's samples as lines of CSV, `rows_per_s` a second or all when there are
/// fewer.
[[nodiscard]] std::string replay_rows(const Trace& trace, std::uint32_t rows_per_s);

inline constexpr std::string_view trajectory_header =
    "algorithm,time_s,cube_l_mm,cube_r_mm,hand_l_mm,hand_r_mm,force_l_n,force_r_n";

/// The rows of a replay as rows of Fig. 7: what lies along x.
[[nodiscard]] std::string trajectory_rows(std::string_view replay_rows, std::string_view algorithm);

} // namespace hapnet::lab
