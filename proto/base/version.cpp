// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/version.hpp"

#include "hapnet_commit.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::base {

std::string_view version() { return HAPNET_VERSION; }

std::string_view commit() { return HAPNET_COMMIT; }

std::string_view compiler()
{
#if defined(__clang__)
    return "Clang " __clang_version__;
#else
    return "GCC " __VERSION__;
#endif
}

std::string version_line(std::string_view program)
{
    return fmt::format("{} {} (commit {}, {})", program, version(), commit(), compiler());
}

} // namespace hapnet::base
