// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/tally.hpp"

namespace hapnet::emulator::tools {

void LossTally::add(bool is_lost)
{
    if (datagrams_ > 0) ++pairs_[(was_lost_ ? 2U : 0U) + (is_lost ? 1U : 0U)];
    ++datagrams_;
    was_lost_ = is_lost;
    if (is_lost) {
        ++losses_;
        ++run_;
        return;
    }
    if (run_ > 0 && began_) end_run();
    run_ = 0;
    began_ = true;
}

void LossTally::end_run()
{
    if (ended_runs_++ % stride_ != 0) return;
    if (runs_.size() < run_) runs_.resize(run_);
    ++runs_[run_ - 1];
}

} // namespace hapnet::emulator::tools
