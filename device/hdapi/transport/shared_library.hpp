// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/hdapi/library.hpp"

#include <string>

namespace hapnet::device::hdapi {

/// Loads libHD from `file`, or with "" by its usual names. It is never unloaded: its driver fails
/// when it is loaded a second time (CHAI3D). The error says what to do.
[[nodiscard]] Opened<Functions> load_library(const std::string& file);

} // namespace hapnet::device::hdapi
