// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/capture_file.hpp"
#include "emulator/tools/learn/measurement.hpp"

namespace hapnet::emulator::tools {

/// Measures a path from one capture. If two interfaces have seen the same payloads, as in a capture
/// of the emulator, the path is measured from one interface to the other, as by measure_ends().
/// Otherwise round trips are measured: from an echo of ping, a question of `probe`, or a UDP
/// datagram whose payload comes back unchanged, to its answer. The error: the capture has none of
/// these.
[[nodiscard]] base::Result<Measurement> measure_capture(const Capture& capture);

/// Measures a path from captures at both its ends: the delays and losses in both directions of the
/// conversation with the most datagrams that both ends have seen. Datagrams are identified by their
/// payload, and those of TCP also by the sequence number, even if their addresses change. A
/// datagram whose payload was sent more than once is left out. Datagrams before the first and after
/// the last that arrived do not count as lost, because a capture may begin late. up is from the end
/// of `a` to that of `b`.
[[nodiscard]] base::Result<Measurement> measure_ends(const Capture& a, const Capture& b);

} // namespace hapnet::emulator::tools
