// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/hid/fake_pid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hapnet::hid_double {

namespace {

// The hand of the simulations, on a grip of 0.2 kg.
constexpr double mass_kg = 0.3;
constexpr double stiffness_n_per_m = 300.0;
constexpr double damping_ns_per_m = 10.0;
constexpr double step_s = 0.0005;

constexpr int magnitude_full = 32767;
constexpr unsigned operation_start = 1;
constexpr unsigned operation_stop = 3;

unsigned byte_at(std::span<const std::byte> data, std::size_t at)
{
    return at < data.size() ? std::to_integer<unsigned>(data[at]) : 0U;
}

unsigned word_at(std::span<const std::byte> data, std::size_t at)
{
    return byte_at(data, at) | (byte_at(data, at + 1) << 8U);
}

void add_word(std::vector<std::byte>& bytes, long value)
{
    bytes.push_back(static_cast<std::byte>(static_cast<unsigned long>(value) & 0xffU));
    bytes.push_back(static_cast<std::byte>((static_cast<unsigned long>(value) >> 8U) & 0xffU));
}

} // namespace

void FakePid::on_output(std::span<const std::byte> report)
{
    const unsigned id = byte_at(report, 0);
    const auto data = report.subspan(1);
    if (id == ids_.set_effect()) {
        on_set_effect(data);
    } else if (id == ids_.set_constant_force()) {
        Effect* const effect = effect_at(byte_at(data, 0));
        const auto magnitude = static_cast<std::int16_t>(word_at(data, 1));
        if (effect != nullptr) effect->magnitude = magnitude;
    } else if (id == ids_.effect_operation()) {
        on_operation(data);
    } else if (id == ids_.block_free()) {
        Effect* const effect = effect_at(byte_at(data, 0));
        if (effect != nullptr) *effect = {};
        return;
    } else if (id == ids_.device_control()) {
        on_control(byte_at(data, 0));
    } else if (id == ids_.device_gain()) {
        gain_ = static_cast<std::uint8_t>(byte_at(data, 0));
        return;
    }
    pushes_.push_back(push());
}

void FakePid::on_set_effect(std::span<const std::byte> data)
{
    Effect* const effect = effect_at(byte_at(data, 0));
    const bool has_direction = (byte_at(data, 12) & 4U) != 0;
    if (effect == nullptr || byte_at(data, 1) != 1 || !has_direction) return;
    effect->lasts_s = word_at(data, 2) / 1000.0;
    effect->direction = static_cast<int>(word_at(data, 13));
    actuators_enabled_ = true; // as OpenFFBoard does
}

void FakePid::on_operation(std::span<const std::byte> data)
{
    Effect* const effect = effect_at(byte_at(data, 0));
    if (effect == nullptr) return;
    if (byte_at(data, 1) == operation_start) {
        effect->started_at = now_s_;
        ++starts_;
    }
    if (byte_at(data, 1) == operation_stop) effect->started_at.reset();
}

void FakePid::on_control(unsigned bits)
{
    if ((bits & 0x01U) != 0) actuators_enabled_ = true;
    if ((bits & 0x02U) != 0) actuators_enabled_ = false;
    if ((bits & 0x04U) != 0) {
        for (Effect& effect : effects_) effect.started_at.reset();
    }
    if ((bits & 0x08U) != 0) {
        effects_ = {};
        actuators_enabled_ = false;
    }
}

void FakePid::on_feature(std::span<const std::byte> report)
{
    if (byte_at(report, 0) != ids_.create_new_effect()) return;
    const auto end = effects_.begin() + static_cast<std::ptrdiff_t>(places_);
    const auto place =
        std::find_if(effects_.begin(), end, [](const Effect& effect) { return !effect.is_taken; });
    if (refuses_ || byte_at(report, 1) != 1) {
        loaded_ = {0, 3};
    } else if (place == end) {
        loaded_ = {0, 2};
    } else {
        place->is_taken = true;
        loaded_ = {static_cast<std::uint8_t>(place - effects_.begin() + 1), 1};
    }
}

std::optional<std::vector<std::byte>> FakePid::feature(std::uint8_t id) const
{
    const auto free = static_cast<unsigned>(places_ - places_taken());
    if (id == ids_.block_load()) return bytes_of({id, loaded_[0], loaded_[1], free, 0});
    return std::nullopt;
}

FakePid::Effect* FakePid::effect_at(unsigned block)
{
    if (block == 0 || block > effects_.size()) return nullptr;
    Effect& effect = effects_.at(block - 1);
    return effect.is_taken ? &effect : nullptr;
}

std::size_t FakePid::places_taken() const
{
    return static_cast<std::size_t>(std::count_if(
        effects_.begin(), effects_.end(), [](const Effect& effect) { return effect.is_taken; }));
}

bool FakePid::plays(const Effect& effect) const
{
    return effect.started_at.has_value() && now_s_ - *effect.started_at <= effect.lasts_s;
}

Push FakePid::push() const
{
    Push sum{.motors_on = actuators_enabled_};
    if (!actuators_enabled_) return sum;
    for (const Effect& effect : effects_) {
        if (!effect.is_taken || !plays(effect)) continue;
        // The effect comes from that direction, so it pushes the other way.
        const double angle = effect.direction * std::numbers::pi / 18000.0;
        const double force_n = force_full_n * effect.magnitude / magnitude_full;
        sum.force_n[0] -= force_n * std::round(std::sin(angle));
        sum.force_n[1] -= force_n * std::round(std::cos(angle));
    }
    return sum;
}

void FakePid::pass(double seconds)
{
    for (double left = seconds; left > 0.0; left -= step_s) {
        const double step = std::min(left, step_s);
        now_s_ += step;
        const Push now = push();
        for (const std::size_t axis : {0U, 1U}) {
            const double force_n = now.force_n.at(axis) +
                                   stiffness_n_per_m * (wanted_m_.at(axis) - at_m_.at(axis)) -
                                   damping_ns_per_m * speed_.at(axis);
            speed_.at(axis) += step * force_n / mass_kg;
            at_m_.at(axis) = std::clamp(at_m_.at(axis) + step * speed_.at(axis), -reach_m, reach_m);
        }
    }
}

std::vector<std::byte> FakePid::input_report() const
{
    std::vector<std::byte> report{std::byte{ids_.input()}};
    add_word(report, button_ ? 1 : 0);
    add_word(report, std::lround(at_m_[0] / reach_m * magnitude_full));
    add_word(report, std::lround(-at_m_[1] / reach_m * magnitude_full)); // toward the user
    for (int axis = 2; axis < 6; ++axis) add_word(report, 0);
    return report;
}

} // namespace hapnet::hid_double
