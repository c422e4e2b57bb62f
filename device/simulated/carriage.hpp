// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/script.hpp"

#include <array>
#include <span>

namespace hapnet::device {

/// A position at which a hand is to be, a number of seconds after the task's start. The hand stops
/// there.
struct Waypoint {
    double at_s = 0.0;
    double x_m = 0.0;
    double y_m = 0.0;
};

/// Takes an object, carries it in the plane z = 0 and puts it down. The hand moves from point to
/// point by minimum jerk, and waits before the first point and after the last.
struct Carriage {
    std::span<const Waypoint> way;
    double grips_s = 0.0;
    double lets_go_s = 0.0;
};

[[nodiscard]] Intention carried(const Carriage& carriage, double t);

// T9, in the scene stack-of-three: cubes of 24 mm on a platform at y = -40 mm. A hand takes one at
// its upper face, lifts it over the tower and lowers it until it stands. A loaded hand hangs 4 mm
// below its aim, so it aims a little below the final position of the cube.
inline constexpr std::array left_of_tower_way{
    Waypoint{0.0, -0.050, 0.005},  Waypoint{1.0, -0.050, 0.005},  Waypoint{2.0, -0.050, -0.015},
    Waypoint{3.0, -0.050, -0.015}, Waypoint{5.0, -0.050, 0.022},  Waypoint{7.5, 0.0, 0.022},
    Waypoint{8.0, 0.0, 0.022},     Waypoint{9.5, 0.0, 0.009},     Waypoint{10.2, 0.0, 0.009},
    Waypoint{11.2, 0.0, 0.030},    Waypoint{12.2, -0.050, 0.030}, Waypoint{13.2, -0.050, 0.010}};
inline constexpr Carriage left_of_tower{left_of_tower_way, 2.5, 10.0};
inline constexpr std::array right_of_tower_way{
    Waypoint{0.0, 0.050, 0.005},   Waypoint{11.0, 0.050, 0.005}, Waypoint{12.0, 0.050, -0.015},
    Waypoint{13.0, 0.050, -0.015}, Waypoint{15.5, 0.050, 0.046}, Waypoint{18.0, 0.0, 0.046},
    Waypoint{18.5, 0.0, 0.046},    Waypoint{20.0, 0.0, 0.033},   Waypoint{20.7, 0.0, 0.033},
    Waypoint{21.7, 0.0, 0.054},    Waypoint{22.7, 0.050, 0.054}, Waypoint{23.7, 0.050, 0.010}};
inline constexpr Carriage right_of_tower{right_of_tower_way, 12.5, 20.5};

// T10, in the scene bench: the screwdriver lies along x, its upper side at y = -4 mm. Both hands
// take it at its middle, 2 mm to their side.
inline constexpr std::array giver_way{Waypoint{0.0, -0.042, 0.010},  Waypoint{1.0, -0.042, 0.010},
                                      Waypoint{2.0, -0.042, -0.003}, Waypoint{3.0, -0.042, -0.003},
                                      Waypoint{5.0, -0.042, 0.025},  Waypoint{7.0, -0.002, 0.025},
                                      Waypoint{10.7, -0.002, 0.025}, Waypoint{11.5, -0.002, 0.045},
                                      Waypoint{12.5, -0.050, 0.045}, Waypoint{13.5, -0.050, 0.010}};
inline constexpr Carriage giver{giver_way, 2.5, 10.5};
inline constexpr std::array taker_way{
    Waypoint{0.0, 0.050, 0.045},   Waypoint{7.0, 0.050, 0.045},  Waypoint{8.0, 0.002, 0.045},
    Waypoint{9.0, 0.002, 0.019},   Waypoint{11.0, 0.002, 0.019}, Waypoint{12.0, 0.002, 0.025},
    Waypoint{14.0, 0.042, 0.025},  Waypoint{14.5, 0.042, 0.025}, Waypoint{16.5, 0.042, -0.005},
    Waypoint{17.5, 0.042, -0.005}, Waypoint{18.5, 0.042, 0.010}};
inline constexpr Carriage taker{taker_way, 9.2, 17.2};

} // namespace hapnet::device
