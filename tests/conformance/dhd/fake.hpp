// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/fake_dhd/fake_dhd.hpp"

#include <dlfcn.h>
#include <stdexcept>
#include <vector>

namespace hapnet::conformance {

/// The fake libdhd. A test sets its state through the same loader as the backend.
class FakeDhd {
public:
    FakeDhd() : library_{dlopen(HAPNET_FAKE_DHD, RTLD_NOW | RTLD_LOCAL)}
    {
        if (library_ == nullptr) throw std::runtime_error{dlerror()};
        find<void()>("fakedhd_reset")();
    }

    void set(FakeDhdFate fate, bool on, int device = 0) const
    {
        find<void(int, FakeDhdFate, bool)>("fakedhd_set")(device, fate, on);
    }
    [[nodiscard]] std::vector<FakeDhdCommand> commands(int device = 0) const
    {
        auto* copy =
            find<std::size_t(int, std::size_t, FakeDhdCommand*, std::size_t)>("fakedhd_commands");
        std::vector<FakeDhdCommand> all(copy(device, 0, nullptr, 0));
        copy(device, 0, all.data(), all.size());
        return all;
    }

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
