#pragma once
#include "core/recording.h"
#include "eval/definitions.h"
