// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ctl/options.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::ctl {

/// Returns the request to send to the program behind the socket. Reads the profile that the options
/// name. The error names the option and says how to correct it.
[[nodiscard]] base::Result<nlohmann::ordered_json> make_request(const Options& options);

} // namespace hapnet::ctl
