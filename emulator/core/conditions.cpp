// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/conditions.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

std::string_view to_text(Direction direction) { return direction == Direction::up ? "up" : "down"; }

std::string_view to_text(Order order)
{
    switch (order) {
    case Order::keep: return "keep";
    case Order::free: return "free";
    case Order::sorted: return "sorted";
    }
    base::ensure(false);
    return {};
}

Conditions patched(Conditions conditions, const Patch& patch)
{
    const auto set = [](auto& target, const auto& value) {
        if (value) target = *value;
    };
    set(conditions.mtu, patch.mtu);
    set(conditions.rate, patch.rate);
    set(conditions.loss, patch.loss);
    set(conditions.corrupt, patch.corrupt);
    set(conditions.duplicate, patch.duplicate);
    set(conditions.delay, patch.delay);
    set(conditions.jitter, patch.jitter);
    set(conditions.order, patch.order);
    set(conditions.reorder, patch.reorder);
    return conditions;
}

} // namespace hapnet::emulator
