// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/record/reader.hpp"

#include <functional>
#include <string_view>

namespace hapnet::lab::records {

/// Writes a record as MCAP with messages of ROS 2. Peer N has the topics /peer_N/hip and
/// /peer_N/body_K (geometry_msgs/PoseStamped), and /peer_N/contact_force and /peer_N/device_force
/// (geometry_msgs/WrenchStamped). Each topic has one message for every tick. The units are metres
/// and newtons, and the axes those of docs/formats/wire.md. Times are on the peer's clock.
void write_mcap(const record::Record& record, const std::function<void(std::string_view)>& take);

/// Writes both peers of a session, on A's clock.
void write_mcap(const Session& session, const std::function<void(std::string_view)>& take);

} // namespace hapnet::lab::records
