#pragma once

#include "eval/statistics/kaplan_meier.h"
