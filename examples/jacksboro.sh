#!/bin/sh
# Prints a GDAL virtual raster of real heights that Debian ships: 344 x 403 cells of three arc
# seconds round Jacksboro, Tennessee, from the package python-matplotlib-data. The heights stay
# where the package has them.
#
#     examples/jacksboro.sh > jacksboro.vrt
#     yamabiko encode jacksboro.vrt -o jacksboro.yb --bytes 100
set -eu

npz=$(dpkg -L python-matplotlib-data 2>/dev/null | grep '/jacksboro_fault_dem\.npz$' || true)
if [ -z "$npz" ]; then
    echo "jacksboro.sh: install the Debian package python-matplotlib-data first" >&2
    exit 1
fi

cat <<XML
<VRTDataset rasterXSize="403" rasterYSize="344">
  <SRS>EPSG:4326</SRS>
  <GeoTransform>-84.41375, 0.0008333333333333334, 0, 36.73291666666667, 0, -0.0008333333333333334</GeoTransform>
  <VRTRasterBand dataType="Int16" band="1" subClass="VRTRawRasterBand">
    <SourceFilename relativeToVRT="0">/vsizip/{$npz}/elevation.npy</SourceFilename>
    <ImageOffset>80</ImageOffset>
    <PixelOffset>2</PixelOffset>
    <LineOffset>806</LineOffset>
    <ByteOrder>LSB</ByteOrder>
  </VRTRasterBand>
</VRTDataset>
XML
