// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/space.hpp"

using namespace hapnet::base;

const Velocity velocity;

#ifdef MUST_COMPILE
const Displacement way = velocity * Duration{1};
#else
const Displacement way = velocity * 0.001;
#endif
