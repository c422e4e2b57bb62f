// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/judgement.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"

#include <cstddef>
#include <memory>

namespace hapnet::emulator {

// Judges that read what is to be lost instead of drawing it.

/// ListedLoss: keeps its place in the list.
class ListJudge {
public:
    ListJudge(const ListedLoss& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&);
    void change(const ListedLoss& law, const base::RandomStream&);

private:
    ListedLoss law_;
    std::size_t next_ = 0; // the first that is not before the datagram
};

/// PatternLoss: has no state.
class PatternJudge {
public:
    PatternJudge(const PatternLoss& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&) const;
    void change(const PatternLoss& law, const base::RandomStream&);

private:
    PatternLoss law_;
};

/// TraceLoss: has no state.
class TraceJudge {
public:
    TraceJudge(const TraceLoss& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&) const;
    void change(const TraceLoss& law, const base::RandomStream&);

private:
    std::shared_ptr<const LossTrace> trace_;
};

/// Outage: keeps its place among the windows.
class OutageJudge {
public:
    OutageJudge(const Outage& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&);
    void change(const Outage& law, const base::RandomStream&);

private:
    Outage law_;
    std::size_t next_ = 0; // the first window that is not over
};

} // namespace hapnet::emulator
