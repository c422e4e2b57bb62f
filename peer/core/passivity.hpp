// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

namespace hapnet::peer {

/// A contact as a hand feels it through a sampled device: a spring and a damper.
struct VirtualWall {
    double stiffness_n_per_m = 0.0;
    double damping_ns_per_m = 0.0;
};

/// Returns a wall with the greatest stiffness and the greatest damping of all contacts that a hand
/// can feel in a scene.
[[nodiscard]] VirtualWall hardest_wall(const scene::Description& scene);

/// Returns the damping that the device and the loosest grip on it must have so that a hand can
/// extract no energy from a sampled wall, in N s/m: K T / 2 + |B|, for a force that is held during
/// the tick and a velocity that is the difference of two samples (J. E. Colgate, J. M. Brown:
/// Factors affecting the Z-width of a haptic display, ICRA 1994). It limits what may be rendered,
/// however exactly the scene is integrated.
[[nodiscard]] double damping_for_passivity(const VirtualWall& wall, double tick_s);

/// Returns the share, 0 to 1, of a wall's force that can be rendered by a device that is stable up
/// to the stiffness `stiffness_max_n_per_m`; 0 means that this stiffness is not known.
[[nodiscard]] double share_within(double stiffness_max_n_per_m, const VirtualWall& wall);

/// Returns the share, 0 to 1, of a wall's force that may be rendered through a port with this
/// damping. Stiffness and damping are reduced equally, so the force is that of the scene times this
/// share.
[[nodiscard]] double passive_share(const VirtualWall& wall, double tick_s,
                                   double port_damping_ns_per_m);

} // namespace hapnet::peer
