/// Everything of the controller.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/controller.hpp>
#include <paperproof/crowd.hpp>
#include <paperproof/pixel_tiles.hpp>
#include <paperproof/plan.hpp>
#include <paperproof/report_vector.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/technique.hpp>
#include <paperproof/techniques.hpp>
#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>
