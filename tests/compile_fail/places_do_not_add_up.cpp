// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/space.hpp"

using namespace hapnet::base;

const Position here;

#ifdef MUST_COMPILE
const auto way = here - here;
#else
const auto way = here + here;
#endif
