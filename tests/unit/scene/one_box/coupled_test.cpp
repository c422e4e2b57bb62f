// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/coupled.hpp"

#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::coupled_test {
namespace {

class Coupled : public testing::Test {
protected:
    Coupled()
    {
        box_.time_left = 1e-3;
        box_.is_coupled = true;
        box_.is_on_plane = false;
        box_.spring_counts = {0, 2, 1};
        for (Trajectory& axis : box_.trajectories)
            axis = {&oscillators_.of(0, false), 0.1, -0.2, 3.0};
    }

    void add(PerAxis normal)
    {
        const double size = std::sqrt(dot(normal, normal));
        for (double& part : normal) part /= size;
        SlantedSpring& spring = box_.slanted[box_.slanted_count++];
        spring.phase = SpringPhase::pressing;
        spring.normal = normal;
    }
    /// Returns the matrix of the modes, multiplied together again.
    [[nodiscard]] double springs_between(std::size_t i, std::size_t k) const
    {
        double sum = 0.0;
        for (std::size_t j = 0; j < 3; ++j) {
            if (!box_.trajectories[j].moves()) continue;
            const double stiffness = room_.coupled.propagators[j].oscillator.stiffness;
            sum += stiffness / oscillators_.spring().stiffness * room_.coupled.direction[j][i] *
                   room_.coupled.direction[j][k];
        }
        return sum;
    }

    Description scene_ = lone_cube();
    WorldConfig config_{.hands = scene_.hands};
    Bodies bodies_{scene_};
    AxisOscillators oscillators_{config_.hands, bodies_.properties[0], 1e-3};
    Obstacles obstacles_{config_, bodies_, bodies_.properties[0]};
    TickRoom room_;
    BoxMotion box_{config_.hands, oscillators_, obstacles_, room_};
};

TEST_F(Coupled, ModesAreAtRightAnglesAndMakeUpTheSprings)
{
    add({1.0, 2.0, -0.5});
    add({-1.0, 0.1, 0.3});
    find_modes(box_);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            double expected = i == k ? static_cast<double>(box_.spring_counts[i]) : 0.0;
            for (const SlantedSpring& spring : box_.active_slanted())
                expected += spring.normal[i] * spring.normal[k];
            EXPECT_NEAR(springs_between(i, k), expected, 1e-14);
            const double angle = dot(room_.coupled.direction[i], room_.coupled.direction[k]);
            EXPECT_NEAR(angle, i == k ? 1.0 : 0.0, 1e-15);
        }
    }
}

TEST_F(Coupled, AnAxisThatIsHeldStaysOutOfTheModes)
{
    add({1.0, 2.0, -0.5});
    box_.trajectories[1].propagator = nullptr;
    find_modes(box_);
    set_modes(box_);
    EXPECT_EQ(room_.coupled.direction[1], (PerAxis{0.0, 1.0, 0.0}));
    EXPECT_EQ(motion_after(box_, 1, 1e-3).displacement, 0.0);
    EXPECT_NE(motion_after(box_, 0, 1e-3).displacement, 0.0);
}

TEST_F(Coupled, TwoHandsAtOneEdgeLeaveTheOtherDirectionsFree)
{
    box_.spring_counts = {};
    add({1.0, 0.0, 1.0});
    add({1.0, 0.0, 1.0});
    find_modes(box_);
    int stiff = 0;
    for (const Propagator& mode : room_.coupled.propagators) {
        if (mode.oscillator.stiffness == 0.0) continue;
        ++stiff;
        EXPECT_NEAR(mode.oscillator.stiffness, 2.0 * oscillators_.spring().stiffness, 1e-9);
    }
    EXPECT_EQ(stiff, 1); // rounding does not make a spring
}

} // namespace
} // namespace hapnet::scene::coupled_test
