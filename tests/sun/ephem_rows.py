"""The Sun at random times from 1900 to 2100 and places, by PyEphem: modified Julian date (UTC), latitude, longitude,
azimuth, elevation without air and with 1010 hPa at 10 degrees Celsius, a line each. usage: ephem_rows.py COUNT"""
import math
import random
import sys

import ephem

random.seed(1)
for _ in range(int(sys.argv[1])):
    day = round(random.uniform(15020, 88069), 6)
    latitude = round(math.degrees(math.asin(random.uniform(-1, 1))), 6)
    longitude = round(random.uniform(-180, 180), 6)
    place = ephem.Observer()
    place.lat, place.lon, place.elevation = math.radians(latitude), math.radians(longitude), 0
    place.date = ephem.Date(day + 2400000.5 - 2415020)
    row = [day, latitude, longitude]
    place.pressure = 0
    sun = ephem.Sun(place)
    row += [math.degrees(sun.az), math.degrees(sun.alt)]
    place.pressure, place.temp = 1010, 10
    row.append(math.degrees(ephem.Sun(place).alt))
    print(*(f"{value:.9f}" for value in row))
