"""What lies around the elastic dam and answers its motion: water with sound, rock with waves."""
