// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/stage.hpp"

namespace hapnet::scene {

/// How the movable bodies of a rigid tick meet each other.
enum class Crowd : std::uint8_t { lone, few, many };

/// Bodies that turn, rest on each other and are pushed by hands.
template <Crowd crowd>
class RigidTick {
public:
    RigidTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);
};

using LoneTick = RigidTick<Crowd::lone>;
using FewTick = RigidTick<Crowd::few>;
using ManyTick = RigidTick<Crowd::many>;

extern template class RigidTick<Crowd::lone>;
extern template class RigidTick<Crowd::few>;
extern template class RigidTick<Crowd::many>;

} // namespace hapnet::scene
