// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/limits.hpp"
#include "device/mount.hpp"
#include "peer/core/peer.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::lab::records {

/// The settings of a peer, and of the governor and the mount between it and its motors.
struct RecordedSettings {
    peer::Settings peer;
    device::GovernorLimits limits;
    device::Mount mount;
};

/// Fails for the configuration of a record whose messages are of another version of the wire.
[[nodiscard]] base::Result<void> check_wire(const nlohmann::json& config);

/// Returns the settings of a record with this configuration. The error names the wrong key.
[[nodiscard]] base::Result<RecordedSettings> settings_of(const nlohmann::json& config);

} // namespace hapnet::lab::records
