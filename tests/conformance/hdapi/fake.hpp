// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/fault.hpp"
#include "tests/support/fake_hd/fake_hd.hpp"

#include <dlfcn.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace hapnet::conformance {

/// The fake libHD. A test sets its state through the same loader as the backend.
class Fake {
public:
    Fake() : library_{dlopen(HAPNET_FAKE_HD, RTLD_NOW | RTLD_LOCAL)}
    {
        if (library_ == nullptr) throw std::runtime_error{dlerror()};
        find<void()>("fakehd_reset")();
    }

    void set(std::size_t device, FakeHdFate fate, bool on) const
    {
        find<void(std::size_t, FakeHdFate, bool)>("fakehd_set")(device, fate, on);
    }
    void fail_frame(std::size_t device, std::uint64_t n) const
    {
        find<void(std::size_t, std::uint64_t)>("fakehd_fail_frame")(device, n);
    }
    void complain(std::size_t device, unsigned int code) const
    {
        find<void(std::size_t, unsigned int)>("fakehd_complain")(device, code);
    }
    [[nodiscard]] std::vector<FakeHdCommand> commands(std::size_t device) const
    {
        auto* copy = find<std::size_t(std::size_t, std::size_t, FakeHdCommand*, std::size_t)>(
            "fakehd_commands");
        std::vector<FakeHdCommand> all(copy(device, 0, nullptr, 0));
        copy(device, 0, all.data(), all.size());
        return all;
    }
    [[nodiscard]] FakeHdMisuse misuse() const { return find<FakeHdMisuse()>("fakehd_misuse")(); }

private:
    template <typename Function>
    [[nodiscard]] Function* find(const char* name) const
    {
        auto* function = reinterpret_cast<Function*>(dlsym(library_, name));
        if (function == nullptr) throw std::runtime_error{dlerror()};
        return function;
    }

    void* library_; // never closed, as the backend does not
};

} // namespace hapnet::conformance
