// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/experiment.hpp"

namespace hapnet::lab::experiment {

namespace {

struct KindName {
    std::string_view operator()(const Table1&) const { return "table1"; }
    std::string_view operator()(const Limits&) const { return "limits"; }
    std::string_view operator()(const Trajectories&) const { return "trajectories"; }
    std::string_view operator()(const ImpairmentGrid&) const { return "plane"; }
    std::string_view operator()(const Calibration&) const { return "calibration"; }
};

} // namespace

std::string name_of(const Hands& hands)
{
    if (hands.left == hands.right) return hands.left.name;
    return hands.left.name + "/" + hands.right.name;
}

std::string_view name_of(const Kind& kind) { return std::visit(KindName{}, kind); }

} // namespace hapnet::lab::experiment
