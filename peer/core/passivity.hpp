// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

namespace hapnet::peer {

/// A spring and damper as a hand feels it through a device that samples.
struct VirtualWall {
    double stiffness_n_per_m = 0.0;
    double damping_ns_per_m = 0.0;
};

/// The stiffest and the most damped that a hand can feel in a scene, as one.
[[nodiscard]] VirtualWall hardest_wall(const scene::Description& scene);

/// The damping that a device and the loosest grip on it have to have so that a hand can draw no
/// energy out of a sampled wall, N s/m: K T / 2 + |B|, for a force held over the tick and a
/// velocity taken from the difference of two samples (J. E. Colgate, J. M. Brown: Factors
/// affecting the Z-width of a haptic display, ICRA 1994). It bounds what may be rendered, however
/// exactly the scene behind it is integrated.
[[nodiscard]] double damping_for_passivity(const VirtualWall& wall, double tick_s);

/// The share, 0 to 1, of a wall's force that a device renders which is known to be stable up to
/// this stiffness, N/m; 0: not known.
[[nodiscard]] double share_within(double stiffness_max_n_per_m, const VirtualWall& wall);

/// The share, 0 to 1, of a wall's force that may be rendered through a port with this damping:
/// stiffness and damping are softened equally, so that the force is the scene's times this share.
[[nodiscard]] double passive_share(const VirtualWall& wall, double tick_s,
                                   double port_damping_ns_per_m);

} // namespace hapnet::peer
