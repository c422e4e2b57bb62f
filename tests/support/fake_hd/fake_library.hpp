// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hdapi/library.hpp"
#include "tests/support/fake_hd/fake_hd.hpp"

#include <array>
#include <atomic>
#include <fstream>
#include <glm/vec3.hpp>
#include <mutex>
#include <thread>
#include <vector>

namespace hapnet::device::hdapi {

inline constexpr std::array names{"Default Device", "Left"};

struct FakeDevice {
    bool is_open = false;
    bool in_frame = false;
    bool docked = false;
    bool calibrated = false;
    bool pressed = false;
    bool unplugged = false;
    bool garbled = false;
    bool warm = false;
    bool force_output = true; // the library's state without a command
    bool clamps = false;
    std::uint64_t failing_frame = 0; // counted down; 0: none
    glm::dvec3 frame_force{0.0};
    glm::dvec3 tip_mm{0.0};
    glm::dvec3 velocity_mm_per_s{0.0};
    std::vector<FakeHdCommand> commands;
};

struct Library {
    std::mutex mutex; // protects all members below
    std::array<FakeDevice, names.size()> devices;
    std::vector<ErrorInfo> errors;
    Handle current = no_device;
    Callback callback = nullptr;
    void* data = nullptr;
    FakeHdMisuse misuse{};
    std::ofstream log; // open: see fake_hd_log_variable
    std::atomic<bool> stalled{false};
    std::atomic<bool> running{false};
    std::thread scheduler;

    FakeDevice* device(Handle handle)
    {
        const bool is_one = handle < devices.size() && devices[handle].is_open;
        if (!is_one) complain(0x104, handle);
        return is_one ? &devices[handle] : nullptr;
    }
    void complain(unsigned int code, Handle handle) { errors.push_back({code, 0, handle}); }
};

/// Returns the library's only state.
[[nodiscard]] Library& library();

/// Records a command that reached the device.
void note(Handle handle, const FakeHdCommand& command);

/// Calls the callback once a millisecond while the library runs: on the scheduler's thread.
void run_scheduler();
void stop_scheduler();

} // namespace hapnet::device::hdapi
