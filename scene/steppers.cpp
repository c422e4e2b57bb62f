// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/steppers.hpp"

namespace hapnet::scene {

Ticks make_ticks(Profile profile, const Description& description, const Frozen& frozen,
                 const Stage& stage)
{
    switch (profile) {
    case Profile::flight: return FlightTick{description, frozen, stage};
    case Profile::sliding: return SlidingTick<false>{description, frozen, stage};
    case Profile::sliding_coulomb: return SlidingTick<true>{description, frozen, stage};
    case Profile::lone: return LoneTick{description, frozen, stage};
    case Profile::few: return FewTick{description, frozen, stage};
    case Profile::many: break;
    }
    return ManyTick{description, frozen, stage};
}

} // namespace hapnet::scene
