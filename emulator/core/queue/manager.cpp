// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/manager.hpp"

#include <chrono>

namespace hapnet::emulator {

QueueManager::QueueManager(const QueueControl& control, const base::RandomStream& stream)
    : stream_{stream}
{
    change(control);
}

void QueueManager::change(const QueueControl& control)
{
    using std::chrono::milliseconds;
    control_ = control;
    if (control.law == QueueLaw::codel) {
        const auto target = control.target.value_or(milliseconds{5});
        if (auto* codel = std::get_if<Codel>(&law_)) {
            codel->change(target, control.codel_interval());
        } else {
            law_.emplace<Codel>(target, control.codel_interval());
        }
    } else if (control.law == QueueLaw::pie) {
        const auto target = control.target.value_or(milliseconds{15});
        if (auto* pie = std::get_if<Pie>(&law_)) {
            pie->change(target);
        } else {
            law_.emplace<Pie>(target);
        }
    } else {
        law_.emplace<std::monostate>();
    }
}

} // namespace hapnet::emulator
