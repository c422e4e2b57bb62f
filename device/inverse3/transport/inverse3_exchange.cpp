// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/inverse3/transport/inverse3_exchange.hpp"

#include "device/inverse3/messages.hpp"

#include <chrono>

namespace hapnet::device::inverse3 {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration answer_max = 10ms;
constexpr int late_answers_max = 64; // further late answers are left to the next exchange

polled::Report fault(Fault what)
{
    polled::Report report;
    report.fault = what;
    return report;
}

} // namespace

std::optional<polled::Report> Inverse3Exchange::tell(const polled::Command& command)
{
    if (!client_.send(force_message(id_, command), answer_max)) return fault(Fault::disconnected);
    std::optional<std::string> answer = client_.receive(answer_max);
    for (int i = 0; answer && i < late_answers_max; ++i) {
        auto newer = client_.receive(0ms);
        if (!newer) break;
        answer = std::move(newer);
    }
    if (!answer) {
        if (!client_.is_open()) return fault(Fault::disconnected);
        return std::nullopt;
    }
    const auto state = parse_state(*answer);
    if (!state) return fault(Fault::communication);
    return report_of(state->find(id_), state->buttons);
}

} // namespace hapnet::device::inverse3
