// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion_model.hpp"

#include "device/simulated/minimum_jerk.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::lab::hands {
namespace {

Places drawn(const MotionModel& model, std::size_t count, std::uint64_t seed)
{
    return simulated(model, count, figures_rate_hz, base::Seed{seed});
}

TEST(MotionModel, DrawsTheSameMotionFromTheSameSeedAtAnyRate)
{
    const MotionModel model;
    EXPECT_EQ(drawn(model, 300, 1), drawn(model, 300, 1));
    EXPECT_NE(drawn(model, 300, 1), drawn(model, 300, 2));
    const auto fine = simulated(model, 3000, 1000.0, base::Seed{1});
    const auto coarse = drawn(model, 150, 1);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        EXPECT_NEAR(fine[20 * i].x, coarse[i].x, 1e-12) << i;
}

TEST(MotionModel, RestsBetweenMovementsOfMinimumJerk)
{
    MotionModel model;
    model.unrest_mm_s = 0.0;
    model.rest_s = 1.0;
    const Places places = drawn(model, 50'000, 3);
    std::size_t still = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
        still += glm::length(places[i] - places[i - 1]) < 1e-15 ? 1U : 0U;
    // A movement lasts exp(0.3^2 / 2) times its median in the mean.
    const double resting = 1.0 / (1.0 + 0.8 * std::exp(0.045));
    EXPECT_NEAR(static_cast<double>(still) / 50e3, resting, 0.03);
    // Half way between two targets, the variance is half of theirs.
    double moving = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double share = device::minimum_jerk((i + 0.5) / 1000.0);
        moving += (share * share + (1.0 - share) * (1.0 - share)) / 1000.0;
    }
    const double variance = resting + (1.0 - resting) * moving;
    EXPECT_NEAR(figures_of(places).spread_x_mm, model.target_x_mm * std::sqrt(variance), 1.5);
}

TEST(MotionModel, HasUnrestOfTheStatedSpeedAndBand)
{
    MotionModel model;
    model.target_x_mm = model.target_y_mm = model.target_z_mm = 1e-3;
    double power = 0.0, half = 0.0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const MotionFigures figures = figures_of(drawn(model, 1000, seed));
        power += figures.speed_mm_s * figures.speed_mm_s / 50.0;
        half += figures.half_power_hz / 50.0;
        EXPECT_LT(figures.most_power_hz, 2.0 * model.unrest_hz + 0.5);
    }
    EXPECT_NEAR(std::sqrt(power), model.unrest_mm_s, 0.5);
    EXPECT_NEAR(half, model.unrest_hz, 0.5);
}

TEST(FittedModel, FindsTheModelOfItsOwnMotions)
{
    MotionModel truth;
    truth.target_x_mm = 30.0;
    truth.target_z_mm = 5.0;
    truth.movement_s = 0.6;
    truth.rest_s = 0.5;
    truth.unrest_mm_s = 15.0;
    truth.unrest_hz = 3.0;
    std::vector<Places> recorded;
    for (std::uint64_t seed = 1001; seed <= 1024; ++seed)
        recorded.push_back(drawn(truth, 400, seed));
    const MotionModel found = fitted_model(recorded);
    EXPECT_NEAR(found.target_x_mm, truth.target_x_mm, 0.2 * truth.target_x_mm);
    EXPECT_NEAR(found.target_y_mm, truth.target_y_mm, 0.2 * truth.target_y_mm);
    EXPECT_NEAR(found.target_z_mm, truth.target_z_mm, 0.2 * truth.target_z_mm);
    EXPECT_NEAR(found.movement_s, truth.movement_s, 0.2 * truth.movement_s);
    EXPECT_NEAR(found.rest_s, truth.rest_s, 0.4 * truth.rest_s);
    EXPECT_NEAR(found.unrest_mm_s, truth.unrest_mm_s, 0.25 * truth.unrest_mm_s);
    EXPECT_NEAR(found.unrest_hz, truth.unrest_hz, 0.25 * truth.unrest_hz);
}

TEST(FittedModel, IsFiniteForAHandThatNeverMoves)
{
    const std::vector<Places> recorded{Places(20, glm::dvec3{0.01})};
    const MotionModel found = fitted_model(recorded);
    for (const auto& place : drawn(found, 20, 5)) EXPECT_LT(glm::length(place), 1e-3);
}

} // namespace
} // namespace hapnet::lab::hands
