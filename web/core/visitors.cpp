// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/visitors.hpp"

#include <algorithm>

namespace hapnet::web {

Visit Visitors::admit(Visitor visitor)
{
    if (all_->size() >= most_) make_room();
    all_->push_back({next_id_, std::move(visitor)});
    return {all_, next_id_++};
}

void Visitors::make_room()
{
    const auto idle =
        std::ranges::find_if(*all_, [](const Entry& entry) { return entry.visitor.is_idle(); });
    const auto leaves = idle == all_->end() ? all_->begin() : idle;
    const Visitor visitor = std::move(leaves->visitor);
    all_->erase(leaves); // before close(), which may end its visit
    visitor.close();
}

void Visitors::close_all()
{
    for (const Entry& entry : std::exchange(*all_, {})) entry.visitor.close();
}

} // namespace hapnet::web
