// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/stage.hpp"

namespace hapnet::scene {

/// One movable box that cannot turn, among fixed boxes and planes parallel to it: every axis is a
/// scalar motion with a closed form, and what begins or ends within a tick is found in it. With
/// `coulomb`, dry friction on what carries the box.
template <bool coulomb>
class SlidingTick {
public:
    SlidingTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);
};

extern template class SlidingTick<false>;
extern template class SlidingTick<true>;

} // namespace hapnet::scene
