// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/capture_file.hpp"
#include "emulator/tools/learn/measurement.hpp"

namespace hapnet::emulator::tools {

/// Measures a path from one capture. With two interfaces that have seen the same payloads, as a
/// capture of the emulator has, it is measured from one to the other, as by measure_ends();
/// otherwise round trips are: from an echo of ping, a question of `probe`, or a UDP datagram whose
/// payload comes back unchanged, to its answer. The error: the capture has none of these.
[[nodiscard]] base::Result<Measurement> measure_capture(const Capture& capture);

/// Measures a path from captures at both its ends: the delays and losses of each way of the
/// conversation with the most datagrams that both have seen. Datagrams are known by their payload,
/// of TCP with the sequence number, whatever becomes of their addresses. One whose payload was sent
/// more than once is left out. Before the first and behind the last that arrived nothing counts as
/// lost: a capture may begin late. up is from the end of `a` to that of `b`.
[[nodiscard]] base::Result<Measurement> measure_ends(const Capture& a, const Capture& b);

} // namespace hapnet::emulator::tools
