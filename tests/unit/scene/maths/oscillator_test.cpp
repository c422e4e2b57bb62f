// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/oscillator.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double tick = 1e-3;

/// The greatest difference between two responses, relative to a free body's.
double difference(const StepResponse& a, const StepResponse& b, double t)
{
    double most = std::abs(a.rate - b.rate);
    most = std::max(most, std::abs(a.step - b.step) / t);
    most = std::max(most, std::abs(a.push - b.push) / (t * t / 2.0));
    return std::max(most, std::abs(a.ramp - b.ramp) / (t * t * t / 6.0));
}

/// The response after two consecutive intervals, from the response to one of them.
StepResponse twice(const Oscillator& oscillator, const StepResponse& r, double t)
{
    const auto way = [&](double x, double v) {
        return x * (1.0 - oscillator.stiffness * r.push) + v * r.step;
    };
    const auto speed = [&](double x, double v) {
        return v * r.rate - x * oscillator.stiffness * r.step;
    };
    return {speed(r.step, r.rate), way(r.step, r.rate), way(r.push, r.step) + r.push,
            way(r.ramp, r.push) + t * r.push + r.ramp};
}

TEST(StepResponse, OfAFreeBodyIsAParabola)
{
    const StepResponse r = step_response({}, tick);
    EXPECT_EQ(r.rate, 1.0);
    EXPECT_EQ(r.step, tick);
    EXPECT_EQ(r.push, 0.5 * (tick * tick));
    EXPECT_DOUBLE_EQ(r.ramp, tick * tick * tick / 6.0);
}

TEST(StepResponse, OfAnOscillatorIsItsSineAndCosine)
{
    const double w = 4321.0;
    const StepResponse r = step_response({.stiffness = w * w}, tick);
    EXPECT_NEAR(r.rate, std::cos(w * tick), 1e-14);
    EXPECT_NEAR(r.step, std::sin(w * tick) / w, 1e-14 * tick);
    EXPECT_NEAR(r.push, (1.0 - std::cos(w * tick)) / (w * w), 1e-14 * tick * tick);
}

TEST(StepResponse, OfADecayIsItsExponential)
{
    const StepResponse r = step_response({.damping = 3000.0}, tick);
    EXPECT_NEAR(r.rate, std::exp(-3.0), 1e-15);
    EXPECT_NEAR(r.step, -std::expm1(-3.0) / 3000.0, 1e-15 * tick);
    EXPECT_NEAR(r.push, (tick + std::expm1(-3.0) / 3000.0) / 3000.0, 1e-15 * tick * tick);
}

TEST(StepResponse, OfTheCriticalCaseIsItsLimit)
{
    const StepResponse r =
        step_response({.damping = 2.0 * 2500.0, .stiffness = 2500.0 * 2500.0}, tick);
    EXPECT_NEAR(r.step, tick * std::exp(-2.5), 1e-15 * tick);
    EXPECT_NEAR(r.rate, (1.0 - 2.5) * std::exp(-2.5), 1e-15);
}

TEST(StepResponse, TwoHalvesMakeAWholeForEveryDampingAndStiffness)
{
    for (double damping = 1e-7; damping < 1e5; damping *= 2.1) {
        for (double stiffness = 1e-7; stiffness < 1e4; stiffness *= 3.3) {
            const Oscillator oscillator{damping / tick, stiffness / (tick * tick)};
            const StepResponse whole = step_response(oscillator, tick);
            const StepResponse halves =
                twice(oscillator, step_response(oscillator, 0.5 * tick), 0.5 * tick);
            ASSERT_LE(difference(whole, halves, tick), 3e-14) << damping << ' ' << stiffness;
        }
    }
}

/// By Taylor's series in more digits: S^(n+2) = -damping S^(n+1) - stiffness S^(n).
StepResponse by_taylor(const Oscillator& oscillator, double t)
{
    const long double time = t, b = oscillator.damping * time,
                      k = oscillator.stiffness * time * time;
    long double before = 0.0L, derivative = 1.0L, factorial = 1.0L;
    long double rate = 0.0L, step = 0.0L, push = 0.0L, ramp = 0.0L;
    for (int n = 1; n < 30; ++n) {
        factorial *= n;
        const long double term = derivative / factorial;
        rate += term * n;
        step += term;
        push += term / (n + 1);
        ramp += term / (n + 1) / (n + 2);
        const long double next = -b * derivative - k * before;
        before = derivative;
        derivative = next;
    }
    return {static_cast<double>(rate), static_cast<double>(step * time),
            static_cast<double>(push * time * time),
            static_cast<double>(ramp * time * time * time)};
}

TEST(StepResponse, OfAWeakOscillatorIsItsTaylorSeries)
{
    for (const double damping : {0.0, 1e-9, 0.01, 0.12, 0.13, 0.9, 1.0}) {
        for (const double stiffness : {0.0, 1e-9, 0.001, 0.031, 0.032, 0.5, 1.0}) {
            const Oscillator oscillator{damping / tick, stiffness / (tick * tick)};
            ASSERT_LE(
                difference(step_response(oscillator, tick), by_taylor(oscillator, tick), tick),
                1e-15)
                << damping << ' ' << stiffness;
        }
    }
}

TEST(StepResponse, StaysFiniteAtTheStiffestThatAnyDescriptionAllows)
{
    for (const Oscillator& oscillator : {Oscillator{0.0, 8e15}, Oscillator{8e12, 8e15},
                                         Oscillator{1e12, 0.0}, Oscillator{1.8e8, 8e15}}) {
        const StepResponse r = step_response(oscillator, 0.1);
        EXPECT_TRUE(std::isfinite(r.rate + r.step + r.push + r.ramp));
        EXPECT_LE(std::abs(r.rate), 1.0);
    }
}

} // namespace
} // namespace hapnet::scene
