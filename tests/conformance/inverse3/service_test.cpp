// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Tests of devices behind a service.
#include "device/inverse3/transport/inverse3s.hpp"
#include "proto/net/clock.hpp"
#include "tests/support/device/ungoverned.hpp"
#include "tests/support/inverse3/fake_service.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;
using Fate = test::FakeInverseService::Fate;

class Inverse3 : public ::testing::Test {
protected:
    void open(const std::string& id = "")
    {
        service_.set(Fate::calibrated, true);
        auto opened = device::inverse3::open_inverse3(id, service_.port());
        ASSERT_TRUE(opened) << opened.error().message;
        device_ = *std::move(opened);
    }
    static void pass(base::Duration duration) { net::sleep_until(net::monotonic_now() + duration); }
    /// Repeats this force and reads every millisecond until the condition holds; at most 5 s.
    template <typename Condition>
    bool push_until(const base::Force& force, Condition is_wanted)
    {
        for (int i = 0; i < 5000; ++i) {
            device_->apply(device::ungoverned(force));
            if (is_wanted(device_->read(net::monotonic_now()))) return true;
            pass(1ms);
        }
        return false;
    }
    bool push_until_fault(device::Fault fault)
    {
        return push_until({{1.0, 0.0, 0.0}}, [&](const auto& it) { return it.fault == fault; });
    }

    test::FakeInverseService service_;
    std::unique_ptr<device::Device> device_; // ends first
};

TEST_F(Inverse3, SaysThatNothingListensAndWhatToDo)
{
    const std::uint16_t port = service_.port();
    service_.stop();
    const auto none = device::inverse3::open_inverse3("", port);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::not_found);
    for (const char* word : {"haply-inverse-service", "--inverse3-port", "127.0.0.1:"}) {
        EXPECT_NE(none.error().message.find(word), std::string::npos) << none.error().message;
    }
    EXPECT_TRUE(device::inverse3::find_inverse3s(port).empty());
}

TEST_F(Inverse3, IsListedWithItsIdentityAndWithoutACommand)
{
    const auto found = device::inverse3::find_inverse3s(service_.port());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.serial, "049D");
    EXPECT_EQ(found[0].identity.note, device::never_run);
    EXPECT_FALSE(found[0].unusable);
    EXPECT_TRUE(service_.forces().empty());
}

TEST_F(Inverse3, IsListedWithTheReasonWhereAnotherProgramUsesIt)
{
    open();
    ASSERT_TRUE(push_until({}, [](const auto& it) { return it.sequence > 0; }));
    const auto found = device::inverse3::find_inverse3s(service_.port());
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].unusable->fault, device::Fault::in_use);
}

TEST_F(Inverse3, IsRefusedUnderAnIdentityThatTheServiceDoesNotKnow)
{
    const auto none = device::inverse3::open_inverse3("049E", service_.port());
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::not_found);
    EXPECT_NE(none.error().message.find("049E"), std::string::npos);
}

TEST_F(Inverse3, IsRefusedWhereItsServicePermutesTheAxes)
{
    service_.set(Fate::permuted, true);
    const auto none = device::inverse3::open_inverse3("", service_.port());
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("XYZ"), std::string::npos);
}

TEST_F(Inverse3, TurnsForcesIntoTheServicesFrameAndPositionsOutOfIt)
{
    open("049D");
    const base::Force force{{0.1, 0.2, 0.3}}; // right, up, toward the user
    EXPECT_TRUE(push_until(force, [](const auto& it) { return it.hip.value.z > 0.1505; }));
    const auto forces = service_.forces();
    EXPECT_NE(std::find(forces.begin(), forces.end(), glm::dvec3{0.1, -0.3, 0.2}), forces.end());
    const glm::dvec3 moved =
        device_->read(net::monotonic_now()).hip.value - glm::dvec3{0.0, 0.19, 0.15};
    EXPECT_NEAR(moved.x / moved.z, 1.0 / 3.0, 1e-6); // a spring holds it
    EXPECT_NEAR(moved.y / moved.z, 2.0 / 3.0, 1e-6);
}

TEST_F(Inverse3, IsGoneWithItsService)
{
    open();
    ASSERT_TRUE(
        push_until({{1.0, 0.0, 0.0}}, [](const auto& it) { return it.hip.value.x > 1e-3; }));
    service_.stop();
    EXPECT_TRUE(push_until_fault(device::Fault::disconnected));
}

TEST_F(Inverse3, IsGoneWithThePowerOfItsMotors)
{
    open();
    service_.set(Fate::unpowered, true);
    EXPECT_TRUE(push_until_fault(device::Fault::disconnected));
}

TEST_F(Inverse3, DropsAForceThatNobodyRepeats)
{
    open();
    ASSERT_TRUE(
        push_until({{1.0, 0.0, 0.0}}, [](const auto& it) { return it.hip.value.x > 1e-3; }));
    pass(200ms); // 20 ms, and what a busy machine adds
    EXPECT_EQ(service_.forces().back(), glm::dvec3{0.0});
}

TEST_F(Inverse3, CountsAPressOfTheGripsButton)
{
    open();
    service_.set(Fate::pressed, true);
    EXPECT_TRUE(push_until({}, [](const auto& it) { return it.gripping && it.presses == 1; }));
}

} // namespace
} // namespace hapnet::conformance
