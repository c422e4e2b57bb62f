// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/hid/pid_descriptor.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::hid_double {

/// The forces of a double's motors.
struct Push {
    std::array<double, 2> force_n{}; // right, away from the user
    bool motors_on = false;

    [[nodiscard]] bool is_zero() const { return force_n[0] == 0.0 && force_n[1] == 0.0; }
};

/// The double of a PID device: a joystick of two axes whose grip is a mass that a hand holds as by
/// a spring. Reads and writes the bytes of pid_descriptor() by their places, on its own. It keeps
/// to the durations of effects. It refuses its Pool report, like some devices that list one. It has
/// no clock: pass() advances its time.
class FakePid {
public:
    explicit FakePid(ReportIds ids = {}) : ids_{ids} {}

    // Takes a report from the host. It begins with its ID.
    void on_output(std::span<const std::byte> report);
    void on_feature(std::span<const std::byte> report);
    /// nullopt: there is no such feature.
    [[nodiscard]] std::optional<std::vector<std::byte>> feature(std::uint8_t id) const;

    void pass(double seconds);
    [[nodiscard]] Push push() const;
    /// Returns all pushes since the beginning: one for each report about forces.
    [[nodiscard]] const std::vector<Push>& pushes() const { return pushes_; }
    /// The place of the grip, metres: right, away from the user.
    [[nodiscard]] std::array<double, 2> grip() const { return at_m_; }
    [[nodiscard]] std::vector<std::byte> input_report() const;

    void press(bool down) { button_ = down; }
    /// Sets the place to which the hand pulls the grip, metres to the right.
    void want(double right_m) { wanted_m_ = {right_m, 0.0}; }
    /// Limits the number of effects, which is 40 at first.
    void limit_places(std::size_t places) { places_ = places; }
    void refuse_effects() { refuses_ = true; }
    [[nodiscard]] std::size_t places_taken() const;
    [[nodiscard]] std::uint8_t gain() const { return gain_; }
    /// Returns the number of effect starts received.
    [[nodiscard]] std::size_t starts() const { return starts_; }
    /// Restores the state after plugging in.
    void power_up()
    {
        std::vector<Push> all = std::move(pushes_);
        *this = FakePid{ids_};
        pushes_ = std::move(all);
    }

    static constexpr double reach_m = 0.08;
    static constexpr double force_full_n = 8.0;

private:
    struct Effect {
        bool is_taken = false;
        double lasts_s = 0.0;
        int direction = 0; // hundredths of a degree
        int magnitude = 0;
        std::optional<double> started_at{};
    };

    void on_set_effect(std::span<const std::byte> data);
    void on_operation(std::span<const std::byte> data);
    void on_control(unsigned bits);
    [[nodiscard]] Effect* effect_at(unsigned block);
    [[nodiscard]] bool plays(const Effect& effect) const;

    ReportIds ids_;
    std::array<Effect, 40> effects_{};
    std::size_t places_ = 40;
    bool refuses_ = false;
    std::array<std::uint8_t, 2> loaded_{}; // block, status
    bool actuators_enabled_ = false;
    std::uint8_t gain_ = 0;
    bool button_ = false;
    double now_s_ = 0.0;
    std::array<double, 2> wanted_m_{};
    std::array<double, 2> at_m_{};
    std::array<double, 2> speed_{};
    std::vector<Push> pushes_;
    std::size_t starts_ = 0;
};

} // namespace hapnet::hid_double
