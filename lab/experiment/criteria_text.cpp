// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/criteria_text.hpp"

#include "proto/base/built_in.hpp"

namespace hapnet::lab::experiment {

base::Result<metrics::Criteria> load_criteria(const std::string& file_or_name,
                                              const base::OpenFile& open)
{
    const auto found = base::find_text(file_or_name, built_in_criteria(), "criteria", open);
    if (!found) return tl::unexpected{found.error()};
    return metrics::parse_criteria(found->text, found->source);
}

} // namespace hapnet::lab::experiment
