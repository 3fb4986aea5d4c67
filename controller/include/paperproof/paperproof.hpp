/// Everything of the controller.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/controller.hpp>
#include <paperproof/report.hpp>
#include <paperproof/saved_state.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/step_context.hpp>
#include <paperproof/together.hpp>
#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>
#include <paperproof/up_frame.hpp>
