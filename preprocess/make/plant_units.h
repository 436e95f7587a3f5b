// The units that a power plant is laid out from, each on a lot of 40 m with a road's half width around it.
#pragma once

#include "preprocess/make/plant_kit.h"

namespace gnomon::make {

/// Half of what a unit may cover in x and z; the rest of its lot is road.
inline constexpr double kUnitHalf = 15;
inline constexpr double kLotPitch = 40;

void addTankFarm(Site& site);
void addPipeRack(Site& site); // covers the lot's whole length in z, so that racks join
void addPipeSleepers(Site& site);
void addExchangers(Site& site);
void addTransformers(Site& site);
void addTurbineHall(Site& site);
void addChimney(Site& site);
void addCoolingTower(Site& site);
void addStore(Site& site);
void addGasTurbine(Site& site);

/// The boiler house in storeys, each a unit of its own; storey 0 stands on the ground.
inline constexpr std::uint64_t kBoilerStoreys = 8;
void addBoilerStorey(Site& site, std::uint64_t storey);

} // namespace gnomon::make
