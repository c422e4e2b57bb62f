// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"

#include <array>
#include <charconv>

namespace hapnet::emulator {

namespace {

void append_number(std::string& text, std::uint64_t number)
{
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(digits.data(), end);
}

void append_time(std::string& text, base::Duration time)
{
    append_number(text, static_cast<std::uint64_t>(time.count()));
}

void append_states(std::string& text, const Fate& fate)
{
    auto last = fate.states.size();
    while (last > 0 && fate.states[last - 1] == LossState::none) --last;
    for (std::size_t i = 0; i < last; ++i) {
        if (i > 0) text += '/';
        text += to_text(fate.states[i]);
    }
}

void append_delivery(std::string& text, const Deliver& deliver)
{
    append_time(text, deliver.after);
    text += ',';
    if (deliver.copy) append_time(text, *deliver.copy);
    text += ',';
    for (std::size_t i = 0; i < deliver.flips.count; ++i) {
        if (i > 0) text += '|';
        append_number(text, deliver.flips.places[i]);
    }
    text += ',';
    const Displacement& displacement = deliver.displacement;
    if (displacement.places > 0) append_number(text, displacement.places);
    text += ',';
    if (displacement.time > base::Duration{0}) append_time(text, displacement.time);
}

} // namespace

void append_row(std::string& text, Direction direction, std::uint64_t number, const Fate& fate)
{
    text += to_text(direction);
    text += ',';
    append_number(text, number);
    const auto* drop = std::get_if<Drop>(&fate.verdict);
    text += drop != nullptr ? ",drop," : ",deliver,";
    if (drop != nullptr) text += to_text(drop->cause);
    text += ',';
    append_states(text, fate);
    text += ',';
    if (drop != nullptr) {
        text += ",,,,";
    } else {
        append_delivery(text, std::get<Deliver>(fate.verdict));
    }
    text += '\n';
}

std::string to_text(const Fates& fates)
{
    std::string text{fates_header};
    text += '\n';
    std::uint64_t number = 0;
    for (const Fate& fate : fates.up) append_row(text, Direction::up, number++, fate);
    number = 0;
    for (const Fate& fate : fates.down) append_row(text, Direction::down, number++, fate);
    return text;
}

} // namespace hapnet::emulator
