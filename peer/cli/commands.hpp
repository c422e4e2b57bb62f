// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/command_line.hpp"
#include "proto/base/result.hpp"

namespace hapnet::peer {

// The commands other than a session. Each returns its exit code.

[[nodiscard]] base::Result<int> run(const ListDevicesCommand& command);
[[nodiscard]] base::Result<int> run(const DoctorCommand& command);
[[nodiscard]] base::Result<int> run(const SelfTestCommand& command);
[[nodiscard]] base::Result<int> run(const KeyCommand& command);

} // namespace hapnet::peer
