/// A JSON scene with one of everything, for tests to change.
#pragma once

namespace paperproof::compare {

inline constexpr const char* good_json_scene = R"({
  "paperproof_scene": 1,
  "name": "room",
  "gravity": [0, -30], "dt": 0.0078125, "steps": 120,
  "character": { "position": [0, 3], "velocity": [0, -40] },
  "scenery": [ { "id": "paper", "polygon": [[-4,0],[4,0],[4,0.01],[-4,0.01]] },
               { "id": "wall", "chain": [[5,0],[5,4]] },
               { "id": "ledge", "chain": [[-2,1],[0,1]], "one_way": [0, 1] },
               { "id": "ring", "polygon": [[10,0],[20,0],[20,10],[10,10]], "holes": [[[12,2],[18,2],[18,8],[12,8]]] } ],
  "movers": [ { "id": "lift", "polygon": [[0,0],[2,0],[2,0.25],[0,0.25]],
                "path": [ { "t": 0, "at": [6,0] }, { "t": 2, "at": [6,3] } ], "loop": "ping_pong" } ],
  "input": [ { "step": 0, "move": 1 }, { "step": 40, "jump": true }, { "step": 44, "jump": false, "drop": true } ]
})";

}  // namespace paperproof::compare
