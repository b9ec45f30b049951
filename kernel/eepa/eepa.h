// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_EEPA_H
#define EEPA_EEPA_H

// The whole kernel. Each header also stands alone.

#include "contact_law.h"
#include "dispatch.h"
#include "dissipation.h"
#include "status.h"
#include "step.h"
#include "time_step.h"
#include "wear.h"

#endif
