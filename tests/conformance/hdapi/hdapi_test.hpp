// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hdapi/transport/hdapis.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/hdapi/fake.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::conformance {

/// Devices of the fake libHD, calibrated already, without a governor.
class Hdapi : public ::testing::Test {
protected:
    Hdapi()
    {
        for (const std::size_t device : {0U, 1U}) {
            fake_.set(device, FakeHdFate::calibrated, true);
        }
    }
    ~Hdapi() override
    {
        devices_.clear();
        const FakeHdMisuse misuse = fake_.misuse();
        EXPECT_EQ(misuse.force_outside_frame, 0U);
        EXPECT_EQ(misuse.nested_frames, 0U);
        EXPECT_EQ(misuse.frames_off_scheduler, 0U);
        EXPECT_EQ(misuse.initialised_while_running, 0U);
    }

    void open(const std::vector<std::string>& names = {"Default Device"})
    {
        auto opened = device::hdapi::open_hdapis(names, HAPNET_FAKE_HD);
        ASSERT_TRUE(opened) << opened.error().message;
        devices_ = *std::move(opened);
    }
    [[nodiscard]] device::Device& device(std::size_t i = 0) { return *devices_.at(i); }

    /// Reads every millisecond until the sample meets the condition; at most 5 s.
    template <typename Condition>
    bool read_until(Condition is_wanted)
    {
        for (int i = 0; i < 5000; ++i) {
            if (is_wanted(device().read(net::monotonic_now()))) return true;
            pass(std::chrono::milliseconds{1});
        }
        return false;
    }
    /// Returns all frames of the first device, once there are more than `count`, or those of 5 s.
    [[nodiscard]] std::vector<FakeHdCommand> frames_beyond(std::size_t count) const
    {
        for (int i = 0; i < 5000 && fake_.commands(0).size() <= count; ++i) {
            pass(std::chrono::milliseconds{1});
        }
        return fake_.commands(0);
    }
    static void pass(base::Duration duration) { net::sleep_until(net::monotonic_now() + duration); }

    Fake fake_;
    std::vector<std::unique_ptr<device::Device>> devices_;
};

} // namespace hapnet::conformance
