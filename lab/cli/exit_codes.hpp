// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::lab {

/// The exit codes of a command that plays nothing, as --help prints them.
inline constexpr const char* exit_codes_without_run = R"(  0  done
  2  bad usage or input
  3  the system refused (no permission, disk full))";

} // namespace hapnet::lab
